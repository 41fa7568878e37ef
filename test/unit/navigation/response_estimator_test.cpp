#include "window_ingress/navigation/response_estimator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace window_ingress::navigation {
namespace {

constexpr double kStep = 1.0 / 30.0, kAssumedSec = 0.3;

/// Flies a vehicle with this lag, and acceleration limit, to and fro in wind. \return what is found
ResponseEstimator flown(double lag_sec, double acceleration_mps2, double seconds) {
  ResponseEstimator estimator(kAssumedSec);
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();
  for (double t = 0.0; t < seconds; t += kStep) {
    const Eigen::Vector3d command(std::fmod(t, 4.0) < 2.0 ? 0.8 : 0.0, std::fmod(t, 3.0) < 1.5 ? 0.3 : -0.3, 0.0);
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

TEST(ResponseEstimator, AVehicleOfLittleAccelerationIsASlowOne) {
  EXPECT_GT(flown(0.2, 0.8, 12.0).responseSec(), 1.5 * flown(0.2, 10.0, 12.0).responseSec());
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
    estimator.update({i % 50 ? wild : nan, -wild, wild}, {-wild, i % 70 ? wild : nan, 0.0}, i % 90 ? kStep : -1.0);
    ASSERT_GE(estimator.responseSec(), 0.5 * kAssumedSec - 1e-9);
    ASSERT_LE(estimator.responseSec(), 3.0 * kAssumedSec + 1e-9);
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

}  // namespace
}  // namespace window_ingress::navigation
