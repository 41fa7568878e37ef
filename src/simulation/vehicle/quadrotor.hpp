#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "simulation/scenario/quadrotor_params.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "simulation/vehicle/velocity_controller.hpp"

namespace window_ingress::simulation {

constexpr double kGravity_mps2 = 9.81;

/// Bounds of the acceleration by thrust that the controllers ask for [m/s^2].
constexpr double kMinThrust_mps2 = 0.2 * kGravity_mps2;
constexpr double kMaxThrust_mps2 = 2.0 * kGravity_mps2;

/// Part of the way to its end that a first-order lag goes in one step.
inline double lagPart(double step_sec, double time_constant_sec) {
  return 1.0 - std::exp(-step_sec / time_constant_sec);
}

/// All motors as one: thrust follows what is asked for with a first-order lag, and is off by the error of its
/// gain and by a payload of which the controllers know nothing.
class Motors {
 public:
  /// They start with what carries the vehicle.
  explicit Motors(const QuadrotorParams& params)
      : gain_((1.0 + params.thrust_gain_error) / params.massRatio()), wanted_mps2_(kGravity_mps2 / gain_) {}

  /// Of the thrust given to the thrust wanted.
  double gain() const { return gain_; }
  void set(double wanted_mps2) { wanted_mps2_ = wanted_mps2; }  ///< at once, without lag
  /// \return acceleration by thrust at the end of the step [m/s^2]
  double step(double wanted_mps2, double step_sec) {
    const double wanted = std::clamp(wanted_mps2, kMinThrust_mps2, kMaxThrust_mps2);
    wanted_mps2_ += lagPart(step_sec, kMotorTimeConstant_sec) * (wanted - wanted_mps2_);
    return gain_ * wanted_mps2_;
  }

 private:
  static constexpr double kMotorTimeConstant_sec = 0.04;

  double gain_, wanted_mps2_;
};

/// Wish for the vehicle's velocity controller, in odometry axes.
struct VelocityCommand {
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double yaw_rate_radps = 0.0;
};

/// What the air does to the vehicle during a step.
struct AirAtVehicle {
  Eigen::Vector3d wind_odom_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d push_odom_mps2 = Eigen::Vector3d::Zero();  ///< beside drag, on a vehicle without payload
};

/// A quadrotor behind a velocity controller. It must tilt to accelerate, so that its camera nods with every
/// move.
///
/// velocity error -> acceleration (`VelocityController`) -> tilt and thrust -> attitude by a second-order
/// loop with limited rates: its closed answer to a small step is 1 / (T Tr s^2 + T s + 1), T the attitude
/// time constant, Tr = `kRateTimeConstant_sec` that of the body rates. Rigid body, thrust along the body's z,
/// drag linear in the speed through the air. The ground (z = 0) carries it. Payload makes all forces count
/// for less.
class Quadrotor {
 public:
  static constexpr double kRateTimeConstant_sec = 0.03;

  /// Starts at rest, trimmed for `wind_odom_mps` (if it does not stand on the ground) and for its payload.
  Quadrotor(const QuadrotorParams& params, const Eigen::Isometry3d& T_odom_base,
            const Eigen::Vector3d& wind_odom_mps = Eigen::Vector3d::Zero());

  /// A command that is not finite is ignored, as a lost one would be.
  void command(const VelocityCommand& command);

  /// Moves on by `step_sec`. The controller sees `estimated_velocity_odom_mps` (axes of the true odom), not
  /// the truth.
  void step(double step_sec, const AirAtVehicle& air, const Eigen::Vector3d& estimated_velocity_odom_mps);

  /// It hit something solid: it stops where it is, its motors stay off, and it falls until its centre is at
  /// `rest_height_m` (or on the ground). There is no way back.
  void crash(double rest_height_m);
  bool crashed() const { return crashed_; }

  const VehicleTruth& truth() const { return truth_; }
  /// What an accelerometer feels: at rest +g on z [m/s^2].
  Eigen::Vector3d specificForceBase() const { return specific_force_base_mps2_; }

 private:
  Eigen::Vector3d wantedForce(const Eigen::Vector3d& velocity_mps, double step_sec);
  void turn(const Eigen::Vector3d& force, double step_sec);
  void move(double thrust_mps2, const AirAtVehicle& air, double step_sec);
  void standOnGround();

  QuadrotorParams params_;
  Motors motors_;
  VehicleTruth truth_;
  VelocityController controller_;
  VelocityCommand command_;
  double command_age_sec_ = 0.0;
  double rest_height_m_;
  bool crashed_ = false;
  Eigen::Vector3d hover_trim_mps2_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_base_mps2_ = Eigen::Vector3d(0, 0, kGravity_mps2);
};

}  // namespace window_ingress::simulation
