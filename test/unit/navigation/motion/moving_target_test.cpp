#include "navigation/motion/moving_target.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "navigation/motion/axis_guidance.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/navigation/commit_criterion.hpp"

namespace window_ingress::navigation::moving_target_test {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

TargetEstimate swinging(double velocity_mps = 0.15) {
  TargetEstimate target;
  target.stamp_sec = target.pose_stamp_sec = 10.0;
  target.T_odom_window = geometry::makePose(geometry::yawRotation(0.4), {3.0, 1.0, 1.5});
  target.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
  target.sign_trusted = true;
  target.opening = {1.2, 1.0};
  target.motion.model = {0.12, 2.0};
  target.motion.velocity_odom_mps = geometry::yawRotation(0.4) * Eigen::Vector3d(0, velocity_mps, 0);
  target.motion.velocity_sigma_mps = 0.03;
  return target;
}

VehicleState standingAt(double distance_m) {
  VehicleState vehicle;
  vehicle.stamp_sec = 10.0;
  const Eigen::Isometry3d T_window_base =
      geometry::makePose(Eigen::Matrix3d::Identity(), {-distance_m, 0.0, 0.0});
  vehicle.T_odom_base = swinging().T_odom_window * T_window_base;
  return vehicle;
}

TEST(MovingTarget, GoesOnWithItsVelocity) {
  const auto later = ahead(swinging(), 10.2);
  const Eigen::Vector3d way = later.T_odom_window.translation() - swinging().T_odom_window.translation();
  EXPECT_NEAR(way.dot(geometry::yawRotation(0.4).col(1)), 0.15 * 0.2, 0.002);
  EXPECT_GT(later.covariance(1, 1), std::pow(0.01 + 0.18 * 0.03, 2));
  EXPECT_GT(later.motion.velocity_sigma_mps, 0.03);
  EXPECT_EQ(later.stamp_sec, 10.0);
}

TEST(MovingTarget, ThatStandsIsLeftAlone) {
  TargetEstimate target = swinging();
  target.motion = {};
  const auto later = ahead(target, 1e9);
  EXPECT_EQ(later.T_odom_window.matrix(), target.T_odom_window.matrix());
  EXPECT_EQ(later.covariance, target.covariance);
  EXPECT_EQ(reachM(target.motion), 0.0);
}

TEST(MovingTarget, NeverGoesBackNorOutOfBounds) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> at(-20.0, 1e4);
  for (int i = 0; i < 300; ++i) {
    const auto later = ahead(swinging(), at(random));
    const double way_m = (later.T_odom_window.translation() - swinging().T_odom_window.translation()).norm();
    EXPECT_LE(way_m, 0.15 * 2.0 + 1e-9);  // its velocity is forgotten
    EXPECT_GE(later.covariance(0, 0), swinging().covariance(0, 0));
    EXPECT_TRUE(later.covariance.allFinite());
  }
  EXPECT_EQ(ahead(swinging(), kNaN).T_odom_window.matrix(), swinging().T_odom_window.matrix());
}

TEST(MovingTarget, IsFollowedSidewaysToItsOwnSide) {
  const NavigatorParams params;
  for (const double velocity_mps : {-0.15, 0.15}) {
    TargetEstimate target = swinging(velocity_mps);
    VehicleState vehicle = standingAt(2.0);
    vehicle.velocity_odom_mps = target.motion.velocity_odom_mps;  // already moving with it
    const auto relative = relate(vehicle, target);
    EXPECT_NEAR(relative.velocity_window_mps.norm(), 0.0, 1e-12);
    const Eigen::Vector3d wish = velocityAlongAxis(relative, target, 0.3, Eigen::Vector3d::Zero(), params);
    const Eigen::Vector3d wish_window = geometry::yawRotation(0.4).transpose() * wish;
    EXPECT_NEAR(wish_window.y(), velocity_mps, 1e-9);
    EXPECT_NEAR(wish_window.x(), 0.3, 1e-9);
  }
}

TEST(MovingTarget, IsCommittedToOnlyIfItCannotMoveAway) {
  NavigatorParams params;
  CommitCriterionInput input;
  input.relative = relate(standingAt(1.4), swinging());
  input.relative.velocity_window_mps.setZero();
  input.opening = {1.2, 1.0};
  const CommitCriterion standing = evaluateCommitCriterion(input, params);
  input.motion = swinging().motion;
  const CommitCriterion slow = evaluateCommitCriterion(input, params);
  EXPECT_GT(slow.miss_m.x(), standing.miss_m.x());
  input.motion.model.speed_mps = 0.5;
  input.motion.velocity_sigma_mps = 0.4;
  const CommitCriterion wild = evaluateCommitCriterion(input, params);
  EXPECT_FALSE(wild.holds);
  EXPECT_NE(wild.unmet.find("predicted"), std::string::npos) << wild.unmet;
}

TEST(MovingTarget, WithMotionOutOfThisWorldIsRefused) {
  EXPECT_EQ(faultOf(swinging()), "");
  const auto refused = [](auto&& spoil) {
    TargetEstimate target = swinging();
    spoil(target);
    return !faultOf(target).empty();
  };
  for (const double bad : {kNaN, -1.0, std::numeric_limits<double>::infinity(), 1e9}) {
    EXPECT_TRUE(refused([&](auto& target) { target.motion.model.speed_mps = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& target) { target.motion.model.time_sec = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& target) { target.motion.velocity_sigma_mps = bad; })) << bad;
  }
  for (const double bad : {kNaN, std::numeric_limits<double>::infinity(), 3.0}) {
    EXPECT_TRUE(refused([&](auto& target) { target.motion.velocity_odom_mps.z() = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& target) {  // a static target has no velocity
      target.motion = {};
      target.motion.velocity_odom_mps.x() = bad;
    })) << bad;
  }
  EXPECT_TRUE(refused([&](auto& target) { target.pose_stamp_sec = kNaN; }));
}

TEST(MovingTarget, IsHandedOnWhereItIsNow) {
  InputMonitor monitor(InputParams{});
  NavigatorInput input;
  input.vehicle = standingAt(3.0);
  input.vehicle->stamp_sec = 10.2;
  input.target = swinging();
  const Situation situation = monitor.judge(input, 10.2);
  ASSERT_TRUE(situation.target);
  EXPECT_EQ(situation.target->T_odom_window.matrix(), ahead(swinging(), 10.2).T_odom_window.matrix());
}

}  // namespace window_ingress::navigation::moving_target_test
