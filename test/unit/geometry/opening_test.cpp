#include "window_ingress/geometry/opening.hpp"

#include <gtest/gtest.h>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::geometry::opening_test {

const PinholeCamera kCamera = PinholeCamera::fromFieldOfView(640, 480, 1.2);

TEST(Opening, SquareViewIsCanonicalAndCentred) {
  const auto image = projectOpening(kCamera, makePose(R_optical_flu(), {0, 0, 4}), {1.2, 1.0});
  ASSERT_TRUE(image);
  EXPECT_EQ(*canonical(*image), *image);
  EXPECT_LT((centroid(*image) - Eigen::Vector2d(319.5, 239.5)).norm(), 1e-9);
  EXPECT_NEAR(aspectRatio(*image), 1.2, 1e-9);
}

TEST(Opening, WindowTurnedLeftShowsItsLeftBorderNearerAndLonger) {
  // A positive relative yaw turns the window's axis to the left: its left border comes towards the camera.
  const Eigen::Matrix3d R = R_optical_flu() * yawRotation(0.5);
  const auto image = projectOpening(kCamera, makePose(R, {0, 0, 4}), {1.2, 1.0});
  ASSERT_TRUE(image);
  const auto T = makePose(R, {0, 0, 4});
  EXPECT_LT((T * openingCorners({1.2, 1.0})[kTopLeft]).z(), (T * openingCorners({1.2, 1.0})[kTopRight]).z());
  EXPECT_GT(sideLengths(*image)[kLeft], sideLengths(*image)[kRight]);
}

TEST(Opening, NoImageWhenACornerIsBehindTheCamera) {
  EXPECT_FALSE(
      projectOpening(kCamera, makePose(R_optical_flu() * yawRotation(1.5), {0, 0, 0.3}), {1.2, 1.0}));
}

}  // namespace window_ingress::geometry::opening_test
