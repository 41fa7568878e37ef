#include "simulation/vehicle/followed_vehicle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "simulation/world.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::followed_vehicle_test {

VehicleTruth at(double x_m, double yaw_rad = 0.0) {
  VehicleTruth truth;
  truth.T_odom_base = geometry::makePose(geometry::yawRotation(yaw_rad), {x_m, 0.0, 1.0});
  return truth;
}

TEST(FollowedVehicle, MovesEvenlyBetweenPosesAndStaysAfterTheLast) {
  FollowedVehicle vehicle(Eigen::Isometry3d::Identity());
  vehicle.follow(at(1.0, 0.0), 10.0);
  EXPECT_DOUBLE_EQ(vehicle.truth().T_odom_base.translation().x(), 1.0) << "the first one counts at once";
  vehicle.follow(at(2.0, 1.0), 10.5);
  vehicle.moveTo(10.25);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().x(), 1.5, 1e-12);
  EXPECT_NEAR(geometry::yawOf(vehicle.truth().T_odom_base.linear()), 0.5, 1e-12);
  vehicle.moveTo(12.0);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().x(), 2.0, 1e-12);
}

TEST(FollowedVehicle, RefusesWhatIsNoPoseAndTimesThatDoNotIncrease) {
  FollowedVehicle vehicle(Eigen::Isometry3d::Identity());
  vehicle.follow(at(0.0), 1.0);
  EXPECT_THROW(vehicle.follow(at(std::nan("")), 2.0), std::invalid_argument);
  EXPECT_THROW(vehicle.follow(at(1.0), std::numeric_limits<double>::infinity()), std::invalid_argument);
  EXPECT_THROW(vehicle.follow(at(1.0), 1.0), std::invalid_argument);
  VehicleTruth bent = at(1.0);
  bent.T_odom_base.linear() *= 2.0;
  EXPECT_THROW(vehicle.follow(bent, 2.0), std::invalid_argument);
  vehicle.moveTo(5.0);
  EXPECT_DOUBLE_EQ(vehicle.truth().T_odom_base.translation().x(), 0.0);
}

TEST(FollowedVehicle, HowFastItFliesItsPlacesTellAndNotItsTwist) {
  FollowedVehicle vehicle(Eigen::Isometry3d::Identity());
  const auto told = [](double x_m) {
    VehicleTruth truth = at(x_m);
    truth.velocity_odom_mps = {0.2, 0.15, 0.0};
    return truth;
  };
  std::vector<double> flown_mps;
  for (int i = 0; i <= 60; ++i) {
    vehicle.follow(told(std::min(2.0, 0.05 * i)), 0.05 * i);
    vehicle.moveTo(0.05 * i);
    flown_mps.push_back(vehicle.flownVelocity().x());
  }
  EXPECT_NEAR(flown_mps[40], 1.0, 1e-9);
  EXPECT_NEAR(flown_mps[50], 0.5, 1e-9) << "half of the past second it stood";
  EXPECT_NEAR(vehicle.flownVelocity().norm(), 0.0, 1e-9);
  EXPECT_DOUBLE_EQ(vehicle.truth().velocity_odom_mps.x(), 0.2) << "the twist as told";
}

Scenario externalScenario() {
  Scenario scenario;
  scenario.vehicle.profile = "external";
  scenario.camera.width_px = 80;
  scenario.camera.height_px = 60;
  return scenario;
}

TEST(ExternalVehicle, IsSeenAndJudgedWhereItIsSaidToBe) {
  World world(externalScenario(), 1);
  const Eigen::Isometry3d T_odom_window = world.T_odom_window();
  const double speed_mps = 0.8, stop_m = 1.6;
  int frames = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x_m = std::min(stop_m, -5.0 + speed_mps * 0.02 * i);
    VehicleTruth truth;
    truth.T_odom_base = T_odom_window * geometry::makePose(Eigen::Matrix3d::Identity(), {x_m, 0.05, 0.0});
    truth.velocity_odom_mps = T_odom_window.linear() * Eigen::Vector3d(0.3, 0.2, 0);  // a poor estimate
    world.follow(truth, 0.02 * i);
    while (world.timeSec() + 0.5 * World::kStepSec < 0.02 * i) {
      world.advance();
      EXPECT_FALSE(world.takeOdometry() || world.takeImu() || world.takeTransform());
      while (const auto exposure = world.takeExposure()) {
        ++frames;
        const double expected_m = std::min(stop_m, -5.0 + speed_mps * exposure->stamp_sec);
        const Eigen::Isometry3d T_window_base = T_odom_window.inverse() * exposure->truth.T_odom_base;
        EXPECT_NEAR(T_window_base.translation().x(), expected_m, 0.02);
      }
    }
  }
  EXPECT_NEAR(frames, 30 * 20, 3);
  const Verdict verdict = world.referee().judge(Claim::kNone);
  EXPECT_EQ(verdict.outcome, Outcome::kPassed) << verdict.reason;
  EXPECT_NEAR(world.referee().crossing()->offset_y_m, 0.05, 1e-6);
  EXPECT_NEAR(world.referee().maxSpeed(), speed_mps, 0.01);
}

TEST(ExternalVehicle, ThatFliesIntoTheWallCollides) {
  World world(externalScenario(), 1);
  for (int i = 0; i < 500; ++i) {
    VehicleTruth truth;
    truth.T_odom_base =
        world.T_odom_window() *
        geometry::makePose(Eigen::Matrix3d::Identity(), {std::min(1.0, -5.0 + 0.02 * i), 1.5, 0.0});
    world.follow(truth, 0.02 * i);
    while (world.timeSec() + 0.5 * World::kStepSec < 0.02 * i) world.advance();
  }
  EXPECT_EQ(world.referee().judge(Claim::kNone).outcome, Outcome::kCollision);
}

}  // namespace window_ingress::simulation::followed_vehicle_test
