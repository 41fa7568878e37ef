#include <gtest/gtest.h>

#include "../pose_fixtures.hpp"
#include "estimation/planar/planar_solutions.hpp"

namespace window_ingress::estimation::stray_border_test {

using namespace fixtures;

/// Moves one border inwards, parallel to itself, with its corners.
detection::WindowObservation withBorderMoved(detection::WindowObservation window, int side,
                                             double inwards_px) {
  std::array<Eigen::Vector3d, 4> lines;
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector2d a = window.corners[i], b = window.corners[(i + 1) % 4];
    const Eigen::Vector2d along = (b - a).normalized(), inwards(-along.y(), along.x());
    if (i == side) a += inwards_px * inwards, b += inwards_px * inwards;
    lines[i] = a.homogeneous().cross(b.homogeneous());
  }
  for (int i = 0; i < 4; ++i) window.corners[i] = lines[(i + 3) % 4].cross(lines[i]).hnormalized();
  return window;
}

struct Errors {
  double yaw_rms = 0.0, squares = 0.0;
  int astray = 0;
};

/// The fitted size differs from the known size.
bool leavesABorderOut(const WindowPoseEstimate& estimate) {
  const auto &fitted = estimate.best.opening, &known = estimate.opening;
  return fitted.width_m != known.width_m || fitted.height_m != known.height_m;
}

Errors errorsWith(int side, double inwards_px, double yaw_rad, int draws = 300) {
  const WindowPoseEstimator estimator{trustingParams()};
  std::mt19937 random(5);
  Errors errors;
  for (int i = 0; i < draws; ++i) {
    auto window = bordersSeen(camera(), view(3.0, yaw_rad, 0.1), 0.5, random);
    if (side >= 0) window = withBorderMoved(window, side, inwards_px);
    const auto result = estimator.estimate(window, camera());
    if (!result.estimate) continue;
    const double error = result.estimate->yaw_rad - yaw_rad;
    errors.yaw_rms += error * error / draws;
    errors.squares += std::pow(error / result.estimate->yaw_sigma_rad, 2) / draws;
    errors.astray += leavesABorderOut(*result.estimate);
    EXPECT_DOUBLE_EQ(result.estimate->opening.width_m, 1.2);
  }
  errors.yaw_rms = std::sqrt(errors.yaw_rms);
  return errors;
}

TEST(StrayBorder, NoiseAloneIsNone) {
  const auto errors = errorsWith(-1, 0.0, 0.3, 4000);
  EXPECT_LT(errors.astray, 10);
  EXPECT_NEAR(errors.squares, 1.0, 0.15);
}

TEST(StrayBorder, ItsPlaceIsNotUsedAndTheYawIsThatOfTheOthers) {
  const double honest = errorsWith(-1, 0.0, 0.3).yaw_rms;
  for (int side = 0; side < 4; ++side) {
    const auto errors = errorsWith(side, 2.0, 0.3);
    EXPECT_GT(errors.astray, 290) << side;
    EXPECT_LT(errors.squares, 3.0) << side;
    EXPECT_LT(errors.yaw_rms, 5.0 * honest + 0.01) << side;
  }
}

TEST(StrayBorder, IsNotLookedForWhereTheSizeIsNotKnown) {
  auto params = trustingParams();
  params.aspect_sigma = 0.3;
  std::mt19937 random(6);
  const auto window = withBorderMoved(bordersSeen(camera(), view(3.0, 0.3), 0.3, random), 2, 3.0);
  const auto result = WindowPoseEstimator{params}.estimate(window, camera());
  ASSERT_TRUE(result.estimate) << result.detail;
  EXPECT_FALSE(leavesABorderOut(*result.estimate));
  EXPECT_LT(result.estimate->opening.height_m / result.estimate->opening.width_m, 1.0 / 1.2);
}

}  // namespace window_ingress::estimation::stray_border_test
