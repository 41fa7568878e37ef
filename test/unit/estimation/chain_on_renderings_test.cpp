/// Renderer, detector and estimator together: one image, one pose, compared with the world's truth.
#include <gtest/gtest.h>

#include <cstdio>

#include "pose_fixtures.hpp"
#include "simulation/camera/reference_image.hpp"
#include "simulation/world.hpp"
#include "window_ingress/detection/window_detector.hpp"

namespace window_ingress::estimation::chain_on_renderings_test {

using namespace fixtures;

simulation::CameraFrame frameOf(simulation::World& world) {
  for (;;) {
    world.advance();
    if (auto frame = world.takeFrame()) return *frame;
  }
}

double largestCornerError(const detection::WindowObservation& window, const geometry::Quadrilateral& truth) {
  double largest = 0.0;
  for (int i = 0; i < 4; ++i) largest = std::max(largest, (window.corners[i] - truth[i]).norm());
  return largest;
}

struct Errors {
  int images = 0, found = 0;
  double yaw_rad = 0, lateral_m = 0, yaw_squares = 0;
};

Errors measure(double distance_m, int images) {
  detection::WindowDetector detector{detection::DetectorParams{}};
  const WindowPoseEstimator estimator{PoseParams{}};
  std::mt19937 random(static_cast<unsigned>(10 * distance_m));
  std::uniform_real_distribution<double> off_axis(-0.6, 0.6), heading(-0.1, 0.1);
  Errors errors;
  for (; errors.images < images; ++errors.images) {
    simulation::Scenario scenario;
    scenario.start.distance_m = distance_m;
    scenario.start.off_axis_rad = off_axis(random);
    scenario.start.heading_rad = heading(random);
    scenario.house.texture_seed = 1 + errors.images;
    simulation::World world(scenario, 1 + errors.images);
    geometry::Quadrilateral opening;
    const cv::Mat reference = simulation::referenceImage(world.scenario(), &opening);
    detector.setReference(detection::ReferenceAppearance(reference, opening));
    const auto frame = frameOf(world);
    const Eigen::Isometry3d& truth = frame.T_camera_window;
    const auto window = detector.detect(frame.image, frame.stamp_sec, &world.camera());
    const auto corners = geometry::projectOpening(world.camera(), truth, world.opening());
    if (!window || !corners || largestCornerError(*window, *corners) > 1.0) continue;
    const GravityPrior gravity{truth.linear().col(2), 0.02};
    const auto result = estimator.estimate(*window, world.camera(), {gravity});
    EXPECT_TRUE(result.estimate) << result.detail;
    if (!result.estimate) continue;
    const Eigen::Isometry3d& pose = result.estimate->best.T_camera_window;
    const double yaw = geometry::yawOf(truth.linear().transpose() * pose.linear());
    errors.yaw_rad += yaw * yaw;
    errors.yaw_squares += std::pow(yaw / result.estimate->yaw_sigma_rad, 2);
    errors.lateral_m += std::pow(pose.inverse().translation().y() - truth.inverse().translation().y(), 2);
    ++errors.found;
  }
  errors.yaw_rad = std::sqrt(errors.yaw_rad / errors.found);
  errors.lateral_m = std::sqrt(errors.lateral_m / errors.found);
  errors.yaw_squares /= errors.found;
  return errors;
}

TEST(ChainOnRenderings, OneImageGivesTheYawToAFractionOfADegree) {
  const double limits[][3] = {{2.0, 0.05, 0.003}, {4.0, 0.2, 0.015}};  // distance [m], yaw [deg], lateral [m]
  for (const auto& [distance, yaw_deg, lateral] : limits) {
    const auto errors = measure(distance, 8);
    std::printf("%g m: found %d of %d, yaw %.3f deg, lateral %.4f m, normalised yaw error squared %.2f\n",
                distance, errors.found, errors.images, errors.yaw_rad / kDegree, errors.lateral_m,
                errors.yaw_squares);
    EXPECT_GE(errors.found, 6);
    EXPECT_LT(errors.yaw_rad, yaw_deg * kDegree);
    EXPECT_LT(errors.lateral_m, lateral);
    EXPECT_LT(errors.yaw_squares, 4.0);
  }
}

}  // namespace window_ingress::estimation::chain_on_renderings_test
