#include "navigation/motion/axis_guidance.hpp"

#include <gtest/gtest.h>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::axis_guidance_test {

const NavigatorParams kDefaults = test::withoutGlass();

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

}  // namespace window_ingress::navigation::axis_guidance_test
