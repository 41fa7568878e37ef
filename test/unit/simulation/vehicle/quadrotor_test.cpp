#include "simulation/vehicle/quadrotor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::quadrotor_test {

constexpr double kStep_sec = 0.0025;
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

Quadrotor hovering(double yaw_rad = 0.0, const QuadrotorParams& params = {},
                   const Eigen::Vector3d& wind = kStill) {
  return Quadrotor(params, geometry::makePose(geometry::yawRotation(yaw_rad), {0, 0, 2.0}), wind);
}

// Its velocity controller uses the true velocity.
void step(Quadrotor& vehicle, const Eigen::Vector3d& wind = kStill) {
  vehicle.step(kStep_sec, {wind, kStill}, vehicle.truth().velocity_odom_mps);
}

void fly(Quadrotor& vehicle, const VelocityCommand& command, double duration_sec,
         const Eigen::Vector3d& wind = kStill) {
  for (double t = 0.0; t < duration_sec; t += kStep_sec) {
    vehicle.command(command);
    step(vehicle, wind);
  }
}

// Angle of the nose below the horizon.
double noseDown(const Quadrotor& vehicle) { return std::asin(-vehicle.truth().T_odom_base.linear()(2, 0)); }

TEST(Quadrotor, HoversWhereItIs) {
  Quadrotor vehicle = hovering();
  fly(vehicle, {}, 10.0);
  EXPECT_LT((vehicle.truth().T_odom_base.translation() - Eigen::Vector3d(0, 0, 2)).norm(), 1e-6);
  EXPECT_NEAR(vehicle.specificForceBase().z(), kGravity_mps2, 1e-6);
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
  EXPECT_LE(vehicle.truth().angular_velocity_base_radps.z(), QuadrotorParams().max_yaw_rate_radps + 1e-9);
}

TEST(Quadrotor, StopsWhenCommandsStopComing) {
  QuadrotorParams params;
  Quadrotor vehicle = hovering(0.0, params);
  fly(vehicle, {Eigen::Vector3d(1.0, 0, 0), 0.4}, 3.0);
  const auto coast = [&](double duration_sec) {
    for (double t = 0.0; t < duration_sec; t += kStep_sec) step(vehicle);
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
  EXPECT_LT(vehicle.truth().velocity_odom_mps.norm(), 1.1 * QuadrotorParams().max_speed_mps);
}

TEST(Quadrotor, NeverTiltsBeyondItsLimitByMuchUnderWildCommands) {
  QuadrotorParams params;
  Quadrotor vehicle = hovering(0.0, params);
  double most_rad = 0.0;
  for (int second = 0; second < 12; ++second) {
    const double sign = second % 2 == 0 ? 1.0 : -1.0;
    for (int i = 0; i < 400; ++i) {
      vehicle.command({Eigen::Vector3d(4.0 * sign, 3.0, -0.1 * sign), 2.0 * sign});
      step(vehicle);
      most_rad = std::max(most_rad, std::acos(vehicle.truth().T_odom_base.linear()(2, 2)));
    }
  }
  EXPECT_GT(most_rad, 0.2);
  EXPECT_LT(most_rad, 1.25 * params.max_tilt_rad);
}

TEST(Quadrotor, StandsOnTheGroundUntilToldToRise) {
  QuadrotorParams params;
  Quadrotor vehicle(params, geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, params.half_height_m}));
  fly(vehicle, {Eigen::Vector3d(0.0, 0, -1.0)}, 1.0);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().z(), params.half_height_m, 1e-9);
  fly(vehicle, {Eigen::Vector3d(0, 0, 0.5)}, 4.0);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().z(), 1.8, 0.3);
}

// The analytic response 1 / (T Tr s^2 + T s + 1) to a step of the commanded tilt.
double secondOrder(double time_sec, double T, double Tr) {
  const double natural = 1.0 / std::sqrt(T * Tr), damping = 0.5 * std::sqrt(T / Tr);
  const double damped = natural * std::sqrt(1.0 - damping * damping), decay = natural * damping;
  return 1.0 - std::exp(-decay * time_sec) *
                   (std::cos(damped * time_sec) + decay / damped * std::sin(damped * time_sec));
}

TEST(Quadrotor, AttitudeAnswersAsItsSecondOrderModel) {
  QuadrotorParams params;
  params.drag_per_sec = params.velocity_integral_per_sec = 0.0;
  params.max_acceleration_mps2 = 2.0;  // always reached: the commanded tilt is a step
  for (const double gain_error : {0.0, 0.15}) {
    params.attitude_gain_error = gain_error;
    const double T = params.attitude_time_constant_sec / (1.0 + gain_error);
    const double wanted_rad = std::atan2(2.0, kGravity_mps2);
    Quadrotor vehicle = hovering(0.3, params);
    for (double t = kStep_sec; t < 0.6; t += kStep_sec) {
      fly(vehicle, {geometry::yawRotation(0.3) * Eigen::Vector3d(5.0, 0, 0)}, 0.5 * kStep_sec);
      const double expected_rad = wanted_rad * secondOrder(t, T, Quadrotor::kRateTimeConstant_sec);
      EXPECT_NEAR(noseDown(vehicle), expected_rad, 0.025 * wanted_rad) << t;
    }
  }
}

double energy(const Quadrotor& vehicle) {
  const auto& truth = vehicle.truth();
  return kGravity_mps2 * truth.T_odom_base.translation().z() + 0.5 * truth.velocity_odom_mps.squaredNorm();
}

TEST(Quadrotor, FallsWithAllItsEnergyLessWhatTheDragTakes) {
  for (const double drag_per_sec : {0.0, 0.25}) {
    QuadrotorParams params;
    params.drag_per_sec = drag_per_sec;
    Quadrotor vehicle(params, geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, 60.0}));
    vehicle.crash(0.0);
    const double before = energy(vehicle);
    double taken = 0.0;
    for (int i = 0; i < 1200; ++i) {
      const double speed_before = vehicle.truth().velocity_odom_mps.norm();
      step(vehicle);
      const double speed = 0.5 * (speed_before + vehicle.truth().velocity_odom_mps.norm());
      taken += drag_per_sec * speed * speed * kStep_sec;
    }
    EXPECT_GT(vehicle.truth().velocity_odom_mps.norm(), 15.0);
    EXPECT_NEAR(energy(vehicle) + taken, before, 0.001 * before);
    EXPECT_NEAR(vehicle.specificForceBase().norm(), drag_per_sec * vehicle.truth().velocity_odom_mps.norm(),
                0.01)
        << "nothing else is felt";
  }
}

TEST(Quadrotor, AfterACrashItStopsFallsAndNeverFliesAgain) {
  Quadrotor vehicle = hovering();
  fly(vehicle, {Eigen::Vector3d(1.5, 0, 0)}, 3.0);
  const double x_m = vehicle.truth().T_odom_base.translation().x();
  vehicle.crash(0.9);
  fly(vehicle, {Eigen::Vector3d(1.5, 0, 1.0), 1.0}, 3.0, {3, 0, 0});
  EXPECT_TRUE(vehicle.crashed());
  EXPECT_DOUBLE_EQ(vehicle.truth().T_odom_base.translation().x(), x_m);
  EXPECT_NEAR(vehicle.truth().T_odom_base.translation().z(), 0.9, 1e-9) << "on what lay below";
  EXPECT_EQ(vehicle.truth().velocity_odom_mps, kStill);
  EXPECT_NEAR(vehicle.specificForceBase().z(), kGravity_mps2, 1e-9);
}

TEST(Quadrotor, PayloadAndThrustErrorMakeItSlowerOrFasterButItHovers) {
  QuadrotorParams heavy, strong;
  heavy.payload_kg = 0.5;
  strong.thrust_gain_error = 0.2;
  const auto climbed = [](const QuadrotorParams& params) {
    Quadrotor vehicle = hovering(0.0, params);
    fly(vehicle, {}, 2.0);
    EXPECT_NEAR(vehicle.truth().T_odom_base.translation().z(), 2.0, 1e-6);
    EXPECT_NEAR(vehicle.specificForceBase().z(), kGravity_mps2, 1e-6) << "hover takes its weight";
    fly(vehicle, {Eigen::Vector3d(0, 0, 1.0)}, 0.4);
    return vehicle.truth().T_odom_base.translation().z() - 2.0;
  };
  const double normal_m = climbed({});
  EXPECT_LT(climbed(heavy), 0.95 * normal_m);
  EXPECT_GT(climbed(strong), 1.03 * normal_m);
  Quadrotor lifting(heavy, geometry::makePose(Eigen::Matrix3d::Identity(), {0, 0, heavy.half_height_m}));
  fly(lifting, {Eigen::Vector3d(0, 0, 0.5)}, 4.0);
  EXPECT_GT(lifting.truth().T_odom_base.translation().z(), 1.3);
}

TEST(Quadrotor, ControlsWhatItBelievesNotTheTruth) {
  Quadrotor vehicle = hovering();
  for (int i = 0; i < 4000; ++i) {
    vehicle.command({Eigen::Vector3d(1.0, 0, 0)});
    const Eigen::Vector3d believed = 1.25 * vehicle.truth().velocity_odom_mps + Eigen::Vector3d(0, 0.1, 0);
    vehicle.step(kStep_sec, Air(), believed);
  }
  EXPECT_NEAR(vehicle.truth().velocity_odom_mps.x(), 0.8, 0.01);
  EXPECT_NEAR(vehicle.truth().velocity_odom_mps.y(), -0.08, 0.005);
}

TEST(Quadrotor, APushMovesItUntilTheTrimHasLearntIt) {
  Quadrotor vehicle = hovering();
  const Air air{kStill, {0.5, 0, 0}};
  double fastest_mps = 0.0;
  for (int i = 0; i < 6000; ++i) {
    vehicle.command({});
    vehicle.step(kStep_sec, air, vehicle.truth().velocity_odom_mps);
    fastest_mps = std::max(fastest_mps, vehicle.truth().velocity_odom_mps.x());
  }
  EXPECT_GT(fastest_mps, 0.05);
  EXPECT_LT(vehicle.truth().velocity_odom_mps.norm(), 0.005);
}

}  // namespace window_ingress::simulation::quadrotor_test
