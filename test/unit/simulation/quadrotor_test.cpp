#include "window_ingress/simulation/quadrotor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kStep_sec = 0.0025;
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

Quadrotor hovering(double yaw_rad = 0.0, const VehicleParams& params = {},
                   const Eigen::Vector3d& wind = kStill) {
  return Quadrotor(params, geometry::makePose(geometry::yawRotation(yaw_rad), {0, 0, 2.0}), wind);
}

void fly(Quadrotor& vehicle, const VelocityCommand& command, double duration_sec,
         const Eigen::Vector3d& wind = kStill) {
  for (double t = 0.0; t < duration_sec; t += kStep_sec) {
    vehicle.command(command);
    vehicle.step(kStep_sec, wind);
  }
}

// Angle of the nose below the horizon.
double noseDown(const Quadrotor& vehicle) { return std::asin(-vehicle.truth().T_odom_base.linear()(2, 0)); }

TEST(Quadrotor, HoversWhereItIs) {
  Quadrotor vehicle = hovering();
  fly(vehicle, {}, 10.0);
  EXPECT_LT((vehicle.truth().T_odom_base.translation() - Eigen::Vector3d(0, 0, 2)).norm(), 1e-6);
  EXPECT_NEAR(vehicle.specificForceBase().z(), Quadrotor::kGravity_mps2, 1e-6);
}

TEST(Quadrotor, MovesAlongTheAxesOfOdometryWhateverItsHeading) {
  for (const double yaw_rad : {0.0, 1.0, -2.5, M_PI}) {
    for (int axis = 0; axis < 3; ++axis) {
      Quadrotor vehicle = hovering(yaw_rad);
      fly(vehicle, {Eigen::Vector3d::Unit(axis) * 0.8, 0.0}, 3.0);
      Eigen::Vector3d moved = vehicle.truth().T_odom_base.translation() - Eigen::Vector3d(0, 0, 2);
      EXPECT_GT(moved[axis], 1.8);
      moved[axis] = 0.0;
      EXPECT_LT(moved.norm(), 0.05) << "yaw " << yaw_rad << " axis " << axis;
    }
  }
}

TEST(Quadrotor, TiltsTowardsItsAccelerationAndBackToBrake) {
  Quadrotor vehicle = hovering();
  fly(vehicle, {Eigen::Vector3d(1.5, 0, 0)}, 0.25);
  EXPECT_GT(noseDown(vehicle), 0.05);
  fly(vehicle, {Eigen::Vector3d(1.5, 0, 0)}, 4.0);
  fly(vehicle, {}, 0.25);
  EXPECT_LT(noseDown(vehicle), -0.03);
  Quadrotor sideways = hovering();
  fly(sideways, {Eigen::Vector3d(0, 1.5, 0)}, 0.25);
  EXPECT_LT(sideways.truth().T_odom_base.linear()(2, 1), -0.05) << "its left side must be the lower one";
}

TEST(Quadrotor, AnswersAStepLikeAnAutopilot) {
  for (const double speed_mps : {0.5, 1.0, 1.5}) {
    Quadrotor vehicle = hovering();
    double t63_sec = 0.0, peak_mps = 0.0, time_sec = 0.0;
    while (time_sec < 6.0) {
      fly(vehicle, {Eigen::Vector3d(speed_mps, 0, 0)}, kStep_sec / 2);
      time_sec += kStep_sec;
      const double now_mps = vehicle.truth().velocity_odom_mps.x();
      if (t63_sec == 0.0 && now_mps >= 0.63 * speed_mps) t63_sec = time_sec;
      peak_mps = std::max(peak_mps, now_mps);
    }
    EXPECT_GT(t63_sec, 0.3) << speed_mps;
    EXPECT_LT(t63_sec, 0.7) << speed_mps;
    EXPECT_LT(peak_mps, 1.2 * speed_mps) << speed_mps;
    EXPECT_NEAR(vehicle.truth().velocity_odom_mps.x(), speed_mps, 0.03 * speed_mps);
  }
}

TEST(Quadrotor, SteadyWindLeavesNoErrorOfTheVelocity) {
  const Eigen::Vector3d wind(2.0, -1.0, 0.3);
  Quadrotor vehicle = hovering(0.4, {}, wind);
  fly(vehicle, {}, 3.0, wind);
  EXPECT_LT((vehicle.truth().T_odom_base.translation() - Eigen::Vector3d(0, 0, 2)).norm(), 0.02)
      << "trimmed at start";
  Quadrotor surprised = hovering(0.4);
  fly(surprised, {Eigen::Vector3d(0.5, 0, 0)}, 15.0, wind);
  EXPECT_LT((surprised.truth().velocity_odom_mps - Eigen::Vector3d(0.5, 0, 0)).norm(), 0.015);
  Quadrotor unwarned = hovering();
  fly(unwarned, {}, 1.0, wind);
  EXPECT_GT(unwarned.truth().T_odom_base.translation().x(), 0.02) << "wind that it does not know pushes it";
}

TEST(Quadrotor, TurnsAtTheYawRateAskedAndNoFasterThanItCan) {
  Quadrotor vehicle = hovering();
  fly(vehicle, {kStill, 0.5}, 3.0);
  EXPECT_NEAR(vehicle.truth().angular_velocity_base_radps.z(), 0.5, 0.01);
  EXPECT_NEAR(geometry::yawOf(vehicle.truth().T_odom_base.linear()), 0.5 * (3.0 - 0.15), 0.03);
  fly(vehicle, {kStill, 50.0}, 3.0);
  EXPECT_LE(vehicle.truth().angular_velocity_base_radps.z(), VehicleParams().max_yaw_rate_radps + 1e-9);
}

TEST(Quadrotor, StopsWhenCommandsStopComing) {
  VehicleParams params;
  Quadrotor vehicle = hovering(0.0, params);
  fly(vehicle, {Eigen::Vector3d(1.0, 0, 0), 0.4}, 3.0);
  const auto coast = [&](double duration_sec) {
    for (double t = 0.0; t < duration_sec; t += kStep_sec) vehicle.step(kStep_sec, kStill);
  };
  coast(0.9 * params.command_timeout_sec);
  EXPECT_GT(vehicle.truth().velocity_odom_mps.x(), 0.95) << "the last setpoint still holds";
  coast(4.0);
  EXPECT_LT(vehicle.truth().velocity_odom_mps.norm(), 0.02);
  EXPECT_NEAR(vehicle.truth().angular_velocity_base_radps.z(), 0.0, 1e-3);
}

TEST(Quadrotor, IgnoresCommandsThatAreNotFiniteAndShortensWildOnes) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  Quadrotor vehicle = hovering();
  fly(vehicle, {Eigen::Vector3d(nan, 0, 0), 0.0}, 0.3);
  fly(vehicle, {Eigen::Vector3d(0, 0, inf), 0.0}, 0.3);
  fly(vehicle, {kStill, nan}, 0.3);
  EXPECT_LT((vehicle.truth().T_odom_base.translation() - Eigen::Vector3d(0, 0, 2)).norm(), 1e-6);
  fly(vehicle, {Eigen::Vector3d(1e9, 1e9, 0), 0.0}, 8.0);
  EXPECT_TRUE(geometry::isValidPose(vehicle.truth().T_odom_base));
  EXPECT_LT(vehicle.truth().velocity_odom_mps.norm(), 1.1 * VehicleParams().max_speed_mps);
}

TEST(Quadrotor, NeverTiltsBeyondItsLimitByMuchUnderWildCommands) {
  VehicleParams params;
  Quadrotor vehicle = hovering(0.0, params);
  double most_rad = 0.0;
  for (int second = 0; second < 12; ++second) {
    const double sign = second % 2 == 0 ? 1.0 : -1.0;
    for (int i = 0; i < 400; ++i) {
      vehicle.command({Eigen::Vector3d(4.0 * sign, 3.0, -0.1 * sign), 2.0 * sign});
      vehicle.step(kStep_sec, kStill);
      most_rad = std::max(most_rad, std::acos(vehicle.truth().T_odom_base.linear()(2, 2)));
    }
  }
  EXPECT_GT(most_rad, 0.2);
  EXPECT_LT(most_rad, 1.25 * params.max_tilt_rad);
}

TEST(Quadrotor, StandsOnTheGroundUntilToldToRise) {
  VehicleParams params;
  Quadrotor vehicle(params, geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, params.half_height_m}));
  fly(vehicle, {Eigen::Vector3d(0.0, 0, -1.0)}, 1.0);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().z(), params.half_height_m, 1e-9);
  fly(vehicle, {Eigen::Vector3d(0, 0, 0.5)}, 4.0);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().z(), 1.8, 0.3);
}

}  // namespace
}  // namespace window_ingress::simulation
