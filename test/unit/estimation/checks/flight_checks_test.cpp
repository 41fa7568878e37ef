#include "estimation/checks/flight_checks.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "evaluation/poses/filter_survey.hpp"
#include "frame_faults.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation::flight_checks_test {

FramesVerdict fly(unsigned seed, const test::FrameFaults& faults, double* way_m = nullptr) {
  auto script = evaluation::drawApproach(seed, evaluation::SizeTold::kAll);
  script.image_rate_hz = 15.0;
  evaluation::SyntheticApproach approach(seed, script, FilterParams());
  FlightChecks check{MountingCheck({}, FilterParams(), {{1.2, 1.0}})};
  while (approach.advance() && check.frames().state != FramesVerdict::kWrong) {
    for (const auto& odometry : approach.odometry())
      check.twist.add(odometry.stamp_sec, odometry.T_odom_base, faults.reported(odometry).velocity_odom_mps);
    if (approach.isInView())
      check.mounting.see(approach.window(), approach.camera(),
                         faults.reported(approach.odometry().back()).T_odom_base,
                         faults.T_base_camera(approach));
  }
  if (way_m) *way_m = approach.flownM();
  return check.frames();
}

TEST(FlightChecks, IsGoodWhereBothAreAndSaysNothingMore) {
  int good = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const auto verdict = fly(seed, {});
    EXPECT_NE(verdict.state, FramesVerdict::kWrong) << verdict.what;
    good += verdict == FramesVerdict{FramesVerdict::kGood, ""};
  }
  EXPECT_GE(good, 38);
}

TEST(FlightChecks, NamesTheTwistsFrameWithinTwoMetres) {
  test::FrameFaults ned;
  ned.twist = "ned";
  for (unsigned seed = 1; seed <= 40; ++seed) {
    double way_m = 0.0;
    const auto verdict = fly(seed, ned, &way_m);
    EXPECT_EQ(verdict.state, FramesVerdict::kWrong);
    EXPECT_NE(verdict.what.find("twist looks like"), std::string::npos) << verdict.what;
    EXPECT_LT(way_m, 2.0);
  }
}

TEST(FlightChecks, FindsATwistInWorldAxes) {
  test::FrameFaults world;
  world.twist = "world";
  int found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) found += fly(seed, world).state == FramesVerdict::kWrong;
  EXPECT_GE(found, 35) << "of 40 headings evenly drawn: near zero, world and body are the same";
}

TEST(FlightChecks, StartsOpenForgetsPlacesAndKeepsWhatItFound) {
  FlightChecks check{MountingCheck({}, FilterParams(), {{1.2, 1.0}})};
  EXPECT_EQ(check.frames().state, FramesVerdict::kUndecided);
  EXPECT_NE(check.frames().what.find("camera mounting"), std::string::npos);
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  for (int i = 0; i < 100; ++i, T.translation().x() += 0.02) check.twist.add(i / 50.0, T, {-1.0, 0, 0});
  EXPECT_EQ(check.frames().state, FramesVerdict::kWrong);
  check.forgetPlaces();
  EXPECT_EQ(check.frames().state, FramesVerdict::kWrong);
  check.clear();
  EXPECT_EQ(check.frames().state, FramesVerdict::kUndecided);
}

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

}  // namespace window_ingress::estimation::flight_checks_test
