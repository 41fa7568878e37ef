#pragma once

#include <Eigen/Geometry>

#include "simulation/scenario/quadrotor_params.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"
#include "simulation/vehicle/velocity_controller.hpp"

namespace window_ingress::simulation {

constexpr double kGravity_mps2 = 9.81;

/// Command for the vehicle's velocity controller, in odometry axes.
struct VelocityCommand {
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double yaw_rate_radps = 0.0;
};

/// Effect of the air on the vehicle during a step, in the axes of the caller.
struct Air {
  Eigen::Vector3d wind_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d push_mps2 = Eigen::Vector3d::Zero();  ///< beside drag, for a vehicle without payload
};

/// A quadrotor with a velocity controller. It must tilt to accelerate, so that its camera nods with every
/// motion.
///
/// velocity error -> acceleration (`VelocityController`) -> tilt and thrust -> attitude by a second-order
/// loop with limited rates. The closed loop answers a small step with 1 / (T Tr s^2 + T s + 1), T the
/// attitude time constant, Tr = `kRateTimeConstant_sec` that of the body rates. Rigid body, thrust along the
/// body's z, drag linear in airspeed. The ground (z = 0) carries the vehicle. Thrust follows its command with
/// a first-order lag. Payload reduces the effect of all forces; the controllers know neither it nor the error
/// of the thrust's gain.
class Quadrotor {
 public:
  static constexpr double kRateTimeConstant_sec = 0.03;

  /// Starts at rest, trimmed for its payload and, unless on the ground, for `wind_odom_mps`.
  Quadrotor(const QuadrotorParams& params, const Eigen::Isometry3d& T_odom_base,
            const Eigen::Vector3d& wind_odom_mps = Eigen::Vector3d::Zero());

  /// Ignores a command that is not finite, as if it were lost.
  void command(const VelocityCommand& command);

  /// Simulates one step. `air` is in the axes of the true odom, as `estimated_velocity_odom_mps`, which the
  /// controller sees in place of the true velocity.
  void step(double step_sec, const Air& air, const Eigen::Vector3d& estimated_velocity_odom_mps);

  /// After a collision: stops the vehicle in place with motors off; it falls until its centre is at
  /// `rest_height_m` or on the ground. This is final.
  void crash(double rest_height_m);
  bool crashed() const { return crashed_; }

  const VehicleTruth& truth() const { return truth_; }
  /// Output of an ideal accelerometer; at rest +g on z [m/s^2].
  Eigen::Vector3d specificForceBase() const { return specific_force_base_mps2_; }

 private:
  Eigen::Vector3d wantedForce(const Eigen::Vector3d& velocity_mps, double step_sec);
  void turn(const Eigen::Vector3d& force, double step_sec);
  void move(double thrust_mps2, const Air& air, double step_sec);
  void standOnGround();

  QuadrotorParams params_;
  double thrust_gain_;         // actual thrust over commanded thrust
  double motor_command_mps2_;  // after the lag of the motors
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
