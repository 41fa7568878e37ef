#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "navigation/behaviours/align.hpp"
#include "navigation/behaviours/search.hpp"
#include "navigation_samples.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation::behaviour_test {

const NavigatorParams kDefaults = test::withoutGlass();

TEST(Home, IsWhereTheMissionBeganAndStaysThereWhenTheOdometryJumps) {
  MissionState mission;
  mission.followVehicle({1, 2, 1}, {0, 0, 0});
  mission.followVehicle({4, 6, 1}, {0, 0, 0});
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(1, 2, 1));
  EXPECT_EQ(mission.from_home_m, Eigen::Vector3d(3, 4, 0));
  mission.forgetPlaces();
  EXPECT_EQ(mission.from_home_m, Eigen::Vector3d(3, 4, 0)) << "until odometry comes back";
  mission.followVehicle({104, 6, 1}, {0, 0, 0});
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(101, 2, 1));
  EXPECT_EQ(mission.from_home_m, Eigen::Vector3d(3, 4, 0));
}

TEST(VelocityTowards, AsksForNoHarderBrakingThanTheVehicleHas) {
  NavigatorParams params;
  for (const double braking_mps2 : {0.5, 1.2, 3.0}) {
    params.vehicle.braking_mps2 = braking_mps2;
    constexpr double kStep = 0.001;
    double error_m = 4.0, last_mps = velocityTowards(error_m, 10.0, params);
    EXPECT_EQ(velocityTowards(-error_m, 10.0, params), -last_mps);
    EXPECT_EQ(velocityTowards(error_m, 0.4, params), 0.4);
    for (double t = 0.0; t < 20.0; t += kStep) {
      error_m -= kStep * last_mps;
      const double speed_mps = velocityTowards(error_m, 10.0, params);
      EXPECT_LE(last_mps - speed_mps, kStep * braking_mps2 * 1.01);
      last_mps = speed_mps;
    }
    EXPECT_NEAR(error_m, 0.0, 1e-3);
    EXPECT_GE(error_m, 0.0) << "never beyond";
  }
}

TEST(OtherWindow, IsLeftRememberedAndNotTakenAgain) {
  MissionState mission;
  Align align{kDefaults, 0.0};
  auto situation = test::situationAt({-5.0, 0.0, 1.5}, 0.0, true);
  situation.target->T_odom_window.translation() = Eigen::Vector3d(5.0, 2.0, 1.5);
  mission.trusted = situation.target;
  mission.window_odom_m = situation.target->T_odom_window.translation();
  EXPECT_NE(align.step(situation, mission).event, Event::kOtherWindow);
  situation.target->other_window = 0.5;
  situation.target->approach_forbidden = "another window: about 0.5 times as large";
  const Decision decision = align.step(situation, mission);
  EXPECT_EQ(decision.event, Event::kOtherWindow);
  EXPECT_EQ(decision.wish.velocity_odom_mps.norm(), 0.0);
  EXPECT_NE(decision.reason.find("0.5 times"), std::string::npos);
  ASSERT_EQ(mission.others_odom_m.size(), 1u);
  EXPECT_TRUE(mission.others_odom_m.front().isApprox(Eigen::Vector3d(0.0, 1.0, 1.5)));
  EXPECT_FALSE(mission.trusted || mission.window_odom_m) << "nothing may be flown by it any more";

  Search search{kDefaults, false};
  for (int i = 0; i < 10; ++i)
    EXPECT_FALSE(search.step(test::situationAt({-5.0, -1.0, 1.5}, 0.1 * i, false), mission).event);
  auto again = test::situationAt({-5.0, -1.0, 1.5}, 1.0, true);
  again.target->T_odom_window.translation() = Eigen::Vector3d(5.0, 3.1, 1.5);  // the same one, from elsewhere
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(search.step(again, mission).event);
  auto right = test::situationAt({-5.0, -1.0, 1.5}, 2.0, true);
  Decision found;
  for (int i = 0; i < 3; ++i) found = search.step(right, mission);
  EXPECT_EQ(found.event, Event::kWindowFound);
}

TEST(OtherWindow, OnceAroundWithoutTheRightOneTheyGetAnotherChance) {
  MissionState mission;
  mission.others_odom_m.push_back({0.0, 0.0, 1.5});
  Search search{kDefaults, false};
  double yaw = 0.0;
  for (int i = 0; i < 10; ++i) search.step(test::situationAt({-4, 0, 1.5}, 0.0, true, yaw), mission);
  EXPECT_EQ(mission.others_odom_m.size(), 1u);
  for (double turned = 0.0; turned < 2.0 * M_PI + 0.1; turned += 0.05) {
    yaw = geometry::wrapAngle(yaw + 0.05);
    search.step(test::situationAt({-4, 0, 1.5}, 0.0, false, yaw), mission);
  }
  EXPECT_TRUE(mission.others_odom_m.empty());
}

// An autopilot that limits the magnitude of its acceleration, in any direction.
TEST(VelocityAlongAxis, WhatAcceleratesSlowlyIsAskedForLittleForwardWhileItIsToMoveAcross) {
  NavigatorParams params = kDefaults;
  const TargetEstimate target = test::targetAtOrigin(0.0);
  const auto forwardAt = [&](double across_m) {
    const RelativeState relative = relate(test::vehicleAt({-1.5, across_m, 1.5}, 0.0), target);
    return velocityAlongAxis(relative, target, 0.9, Eigen::Vector3d::Zero(), params).x();
  };
  EXPECT_NEAR(forwardAt(0.0), 0.9, 1e-9);
  params.vehicle.braking_mps2 = 0.5;
  EXPECT_LT(forwardAt(0.3), 0.2);
  EXPECT_LT(forwardAt(-0.3), 0.2);
  EXPECT_NEAR(forwardAt(0.0), 0.9, 1e-9);
}

TEST(VelocityAlongAxis, AwayFromTheWindowGoesBeforeSideways) {
  const TargetEstimate target = test::targetAtOrigin(0.0);
  const auto wishFor = [&](double forward_mps) -> Eigen::Vector3d {
    const RelativeState relative = relate(test::vehicleAt({-1.5, 2.0, 2.5}, 0.0), target);
    return velocityAlongAxis(relative, target, forward_mps, {0.0, 0.4, 0.0}, kDefaults);
  };
  EXPECT_EQ(wishFor(-0.8).x(), -0.8);
  EXPECT_NEAR(wishFor(-0.8).norm(), kDefaults.limits.speed_mps, 1e-9);
  EXPECT_EQ(wishFor(-3.0), Eigen::Vector3d(-kDefaults.limits.speed_mps, 0.0, 0.0));
  EXPECT_NEAR(wishFor(0.8).tail<2>().norm(), kDefaults.limits.speed_mps, 1e-9);
}

}  // namespace window_ingress::navigation::behaviour_test
