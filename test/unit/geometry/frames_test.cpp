#include "window_ingress/geometry/frames.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace window_ingress::geometry::frames_test {

TEST(Frames, OpticalAxesAreRightDownForward) {
  const Eigen::Matrix3d R = R_optical_flu();
  EXPECT_TRUE((R * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d(0, 0, 1)));   // forward
  EXPECT_TRUE((R * Eigen::Vector3d::UnitY()).isApprox(Eigen::Vector3d(-1, 0, 0)));  // left
  EXPECT_TRUE((R * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d(0, -1, 0)));  // up
  EXPECT_DOUBLE_EQ(R.determinant(), 1.0);
}

TEST(Frames, YawRotationTurnsCounterClockwiseSeenFromAbove) {
  EXPECT_TRUE((yawRotation(M_PI_2) * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY()));
  for (double yaw = -3.1; yaw <= 3.1; yaw += 0.1) EXPECT_NEAR(yawOf(yawRotation(yaw)), yaw, 1e-12);
}

TEST(Frames, WrapAngleStaysInHalfOpenInterval) {
  EXPECT_NEAR(wrapAngle(3 * M_PI), M_PI, 1e-12);
  EXPECT_NEAR(wrapAngle(-M_PI), M_PI, 1e-12);
  EXPECT_NEAR(wrapAngle(-0.5), -0.5, 1e-15);
  for (double angle = -50; angle < 50; angle += 0.37) {
    EXPECT_GT(wrapAngle(angle), -M_PI);
    EXPECT_LE(wrapAngle(angle), M_PI);
    EXPECT_NEAR(std::sin(wrapAngle(angle)), std::sin(angle), 1e-9);
  }
}

TEST(Frames, ValidPoseRefusesNanScaleAndMirror) {
  Eigen::Isometry3d pose = makePose(yawRotation(0.4), {1, 2, 3});
  EXPECT_TRUE(isValidPose(pose));
  pose.translation().x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(isValidPose(pose));
  EXPECT_FALSE(isValidPose(makePose(2.0 * yawRotation(0.4), {1, 2, 3})));
  Eigen::Matrix3d mirror = Eigen::Matrix3d::Identity();
  mirror(0, 0) = -1;
  EXPECT_FALSE(isValidPose(makePose(mirror, {0, 0, 0})));
}

}  // namespace window_ingress::geometry::frames_test
