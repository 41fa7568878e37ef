#include <gtest/gtest.h>

#include <algorithm>

#include "evaluation/images/survey_image.hpp"
#include "simulation/scenario/scenario.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation::survey_view_test {

using Eigen::Vector3d;

const simulation::Scenario kScenario;

simulation::Surface grey() { return {}; }

TEST(SurveyView, ShowsTheWholeOpeningWithinTheRange) {
  const simulation::Scene scene = simulation::buildScene(kScenario);
  const auto camera = kScenario.camera.model();
  ViewRange range;
  double nearest_m = 99.0, farthest_m = 0.0, left = 1.0, right = -1.0;
  for (std::uint32_t seed = 1; seed <= 60; ++seed) {
    const SurveyView view = drawView(kScenario, scene, camera, range, seed);
    const auto quad = geometry::projectOpening(camera, view.motion.T_camera_window(0.0), kScenario.opening());
    ASSERT_TRUE(quad);
    for (const auto& corner : *quad) EXPECT_TRUE(camera.contains(corner, range.margin_px));
    const Vector3d eye = view.motion.T_window_camera.translation();
    EXPECT_NEAR(eye.head<2>().norm(), view.distance_m, 1e-9);
    EXPECT_NEAR(std::atan2(eye.y(), -eye.x()), view.off_axis_rad, 1e-9);
    EXPECT_LE(std::abs(view.off_axis_rad), range.off_axis_rad);
    EXPECT_LE(std::abs(eye.z()), 0.4);
    nearest_m = std::min(nearest_m, view.distance_m), farthest_m = std::max(farthest_m, view.distance_m);
    left = std::min(left, (*quad)[0].x() / camera.width),
    right = std::max(right, (*quad)[1].x() / camera.width);
  }
  EXPECT_TRUE(nearest_m >= 2.0 && nearest_m < 2.8) << nearest_m;
  EXPECT_TRUE(farthest_m <= 8.0 && farthest_m > 7.2) << farthest_m;
  EXPECT_LT(left, 0.15) << "anywhere in the image";
  EXPECT_GT(right, 0.85);
}

TEST(SurveyView, TheSameSeedTheSameViewAnotherSeedAnother) {
  const simulation::Scene scene = simulation::buildScene(kScenario);
  const auto poseOf = [&](std::uint32_t seed) {
    return drawView(kScenario, scene, kScenario.camera.model(), {}, seed).motion.T_window_camera.matrix();
  };
  EXPECT_EQ(poseOf(3), poseOf(3));
  EXPECT_NE(poseOf(3), poseOf(4));
}

TEST(SurveyView, StillCameraDoesNotMoveAndStandsWhereTheMovingOneIs) {
  const simulation::Scene scene = simulation::buildScene(kScenario);
  ViewRange range;
  const auto moving = drawView(kScenario, scene, kScenario.camera.model(), range, 9).motion;
  range.still = true;
  const auto still = drawView(kScenario, scene, kScenario.camera.model(), range, 9).motion;
  EXPECT_EQ(moving.T_window_camera.matrix(), still.T_window_camera.matrix());
  EXPECT_GT(moving.velocity_window_mps.norm(), 0.0);
  EXPECT_LT(moving.velocity_window_mps.norm(), 0.9);
  EXPECT_EQ(still.velocity_window_mps.norm() + still.angular_velocity_camera_radps.norm(), 0.0);
}

TEST(SurveyView, WindowThatNeverFitsIsAnError) {
  simulation::Scenario large;
  large.window.width_m = 4.0;
  large.house.width_m = 12.0;
  ViewRange near;
  near.nearest_m = near.farthest_m = 0.8;
  EXPECT_THROW(drawView(large, simulation::buildScene(large), large.camera.model(), near, 1),
               std::runtime_error);
}

TEST(SurveyView, AnythingBeforeTheBorderHidesIt) {
  const Vector3d eye(-3.0, 0.5, 0.1);
  const geometry::OpeningSize opening{1.2, 1.0};
  simulation::Mesh mesh(simulation::Lighting{});
  EXPECT_TRUE(borderIsFree(mesh, eye, opening));
  mesh.addBox({Vector3d(0.1, -1, -1), Vector3d(0.2, 1, 1)}, grey());
  EXPECT_TRUE(borderIsFree(mesh, eye, opening)) << "behind the window's plane";
  mesh.addBox({Vector3d(-4.0, -1, -1), Vector3d(-3.5, 1, 1)}, grey());
  EXPECT_TRUE(borderIsFree(mesh, eye, opening)) << "behind the eye";
  simulation::Mesh post = mesh;
  post.addBox({Vector3d(-1.1, -0.1, -1.5), Vector3d(-1.0, 0.1, 1.5)}, grey());
  EXPECT_FALSE(borderIsFree(post, eye, opening)) << "a post across upper and lower side";
}

TEST(SurveyView, ShutterSeesEachCornerInItsRowsTime) {
  const auto camera = kScenario.camera.model();
  simulation::CameraTruth motion;
  motion.T_window_camera =
      geometry::makePose(geometry::R_optical_flu().transpose(), Vector3d(-4.0, 0.0, 0.0));
  motion.velocity_window_mps = {0.0, 1.0, 0.0};
  const auto at_once = *projectMoving(camera, motion, 0.0, {1.2, 1.0}, 0.0);
  const auto by_rows = *projectMoving(camera, motion, 0.03, {1.2, 1.0}, 0.0);
  const double rows = at_once[geometry::kBottomLeft].y() - at_once[0].y();
  const double shift_px = camera.fx / 4.0 * 0.03 * rows / camera.height;
  EXPECT_NEAR((by_rows[geometry::kBottomLeft].x() - by_rows[0].x()), shift_px, 0.01)
      << "sheared to the right";
  EXPECT_NEAR(0.5 * (by_rows[geometry::kBottomLeft].x() + by_rows[0].x()), at_once[0].x(), 0.05);
}

}  // namespace window_ingress::evaluation::survey_view_test
