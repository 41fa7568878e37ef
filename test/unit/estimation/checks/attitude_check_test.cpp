#include "estimation/checks/attitude_check.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::attitude_check_test {

Eigen::Matrix3d turned(double rad, const Eigen::Vector3d& axis) {
  return Eigen::AngleAxisd(rad, axis).toRotationMatrix();
}

FramesVerdict seen(const Eigen::Matrix3d& imu, const Eigen::Matrix3d& odometry, int times) {
  AttitudeCheck check;
  for (int i = 0; i < times; ++i) check.see(imu, odometry);
  return check.verdict();
}

TEST(AttitudeCheck, HeadingsMayDifferUpMayNot) {
  const Eigen::Matrix3d tilted = geometry::yawRotation(2.0) * turned(0.3, Eigen::Vector3d::UnitX());
  EXPECT_EQ(seen(geometry::yawRotation(-1.3) * tilted, tilted, 20).state, FramesVerdict::kGood);
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
    EXPECT_EQ(seen(tilted * turned(M_PI, axis), tilted, 20).state, FramesVerdict::kWrong);
    const auto level = seen(turned(M_PI, axis), Eigen::Matrix3d::Identity(), 20);
    EXPECT_NE(level.what.find("180 deg"), std::string::npos) << level.what;
  }
}

TEST(AttitudeCheck, AMomentDecidesNothing) {
  const Eigen::Matrix3d level = Eigen::Matrix3d::Identity(), tipped = turned(1.0, Eigen::Vector3d::UnitX());
  EXPECT_EQ(seen(level, level, 5).state, FramesVerdict::kUndecided);
  EXPECT_EQ(seen(tipped, level, 5).state, FramesVerdict::kUndecided);
  AttitudeCheck check;
  for (int i = 0; i < 100; ++i) EXPECT_EQ(check.see(i % 9 == 0 ? level : tipped, level), i % 9 == 0);
  EXPECT_NE(check.verdict().state, FramesVerdict::kWrong);
}

TEST(AttitudeCheck, WhatIsNotFiniteDoesNotAgree) {
  AttitudeCheck check;
  const Eigen::Matrix3d nan = Eigen::Matrix3d::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(check.see(nan, Eigen::Matrix3d::Identity()));
}

}  // namespace window_ingress::estimation::attitude_check_test
