#include "navigation/motion/response_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "navigation/motion/stopping.hpp"

namespace window_ingress::navigation::response_estimator_test {

constexpr double kStep = 1.0 / 30.0, kAssumedSec = 0.3;

/// Flies a vehicle with this lag and acceleration limit to and fro in wind. \return the estimator
ResponseEstimator flown(double lag_sec, double acceleration_mps2, double seconds) {
  ResponseEstimator estimator(kAssumedSec);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (double t = 0.0; t < seconds; t += kStep) {
    const Eigen::Vector3d command(std::fmod(t, 4.0) < 2.0 ? 0.8 : 0.0, std::fmod(t, 3.0) < 1.5 ? 0.3 : -0.3,
                                  0.0);
    Eigen::Vector3d change = (command - velocity) / lag_sec;
    if (change.norm() > acceleration_mps2) change *= acceleration_mps2 / change.norm();
    velocity += kStep * change;
    estimator.update(velocity + Eigen::Vector3d(0.2, -0.1, 0.0), command, kStep);
  }
  return estimator;
}

TEST(ResponseEstimator, FindsTheLagOfTheVehicleInWind) {
  for (const double lag_sec : {0.16, 0.3, 0.45, 0.6, 0.85}) {
    const double found_sec = flown(lag_sec, 10.0, 12.0).responseSec();
    EXPECT_GT(found_sec, 0.75 * lag_sec);
    EXPECT_LT(found_sec, 1.35 * lag_sec);
  }
}

// Response and acceleration limit together determine the stopping distance.
TEST(ResponseEstimator, KnowsHowFarAVehicleOfLittleAccelerationGoes) {
  const auto stop_m = [](double acceleration_mps2, double response_sec) {
    VehicleParams vehicle;
    vehicle.braking_mps2 = acceleration_mps2;
    vehicle.response_sec = response_sec;
    return stoppingDistance(0.8, vehicle);
  };
  for (const double acceleration_mps2 : {0.5, 0.6, 1.0}) {
    const ResponseEstimator found = flown(0.2, acceleration_mps2, 12.0);
    EXPECT_LT(found.accelerationMps2(), 2.0) << acceleration_mps2;
    EXPECT_NEAR(stop_m(found.accelerationMps2(), found.responseSec()) / stop_m(acceleration_mps2, 0.3), 1.0,
                0.35)
        << acceleration_mps2;
  }
  EXPECT_GT(flown(0.3, 10.0, 12.0).accelerationMps2(), 1.2);
}

// The vehicle is held by a hand or stands on the ground: its response is unknown.
TEST(ResponseEstimator, AVehicleThatDoesNotAnswerIsBelievedToBeAsAssumed) {
  ResponseEstimator estimator(kAssumedSec);
  for (int i = 0; i < 600; ++i)
    estimator.update({0.01 * std::sin(0.7 * i), 0.0, 0.0}, {i % 120 < 60 ? 0.8 : -0.4, 0.0, 0.0}, kStep);
  EXPECT_FALSE(estimator.isMeasured());
  EXPECT_EQ(estimator.responseSec(), kAssumedSec);
  EXPECT_GT(estimator.accelerationMps2(), 100.0);
}

// The navigator needs the response before it brakes for the first time.
TEST(ResponseEstimator, KnowsASlowVehicleAfterItsFirstSecondOfAcceleration) {
  for (const double assumed_sec : {0.15, 0.3, 0.6}) {
    ResponseEstimator estimator(assumed_sec);
    double speed_mps = 0.0;
    for (double t = 0.0; t < 2.5; t += kStep) {
      const double command_mps = t < 1.0 ? 0.0 : 0.75;
      speed_mps += std::clamp(command_mps - speed_mps, -0.6 * kStep, 0.6 * kStep);
      estimator.update({0.0, speed_mps, 0.0}, {0.0, command_mps, 0.0}, kStep);
    }
    EXPECT_TRUE(estimator.isMeasured());
    EXPECT_LT(estimator.accelerationMps2(), 0.75) << assumed_sec;
  }
}

TEST(ResponseEstimator, BelievesWhatIsAssumedUntilTheVehicleHasBeenAskedToChange) {
  ResponseEstimator estimator(kAssumedSec);
  for (int i = 0; i < 300; ++i) estimator.update({0.1, 0.2, 0.0}, {0.0, 0.0, 0.0}, kStep);
  EXPECT_FALSE(estimator.isMeasured());
  EXPECT_EQ(estimator.responseSec(), kAssumedSec);
}

TEST(ResponseEstimator, StaysWithinBoundsWhateverComes) {
  ResponseEstimator estimator(kAssumedSec);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 3000; ++i) {
    const double wild = 5.0 * std::sin(7.0 * i * i);
    estimator.update({i % 50 ? wild : nan, -wild, wild}, {-wild, i % 70 ? wild : nan, 0.0},
                     i % 90 ? kStep : -1.0);
    ASSERT_GE(estimator.responseSec(), 0.12);
    ASSERT_LE(estimator.responseSec(), 0.9);
    ASSERT_GE(estimator.accelerationMps2(), 0.5);
    ASSERT_TRUE(estimator.velocity().allFinite());
  }
}

TEST(ResponseEstimator, ARestartForgetsTheMotionAndAResetTheVehicle) {
  ResponseEstimator estimator = flown(0.85, 10.0, 12.0);
  const double found_sec = estimator.responseSec();
  estimator.restart();
  EXPECT_EQ(estimator.responseSec(), found_sec);
  estimator.reset();
  EXPECT_EQ(estimator.responseSec(), kAssumedSec);
}

}  // namespace window_ingress::navigation::response_estimator_test
