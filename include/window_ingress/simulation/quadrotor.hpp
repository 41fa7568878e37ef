#pragma once

#include <Eigen/Geometry>

#include "window_ingress/simulation/scenario.hpp"
#include "window_ingress/simulation/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// Wish for the vehicle's velocity controller, in odometry axes.
struct VelocityCommand {
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double yaw_rate_radps = 0.0;
};

/// A quadrotor behind a velocity controller. It must tilt to accelerate, so that its camera nods with every
/// move.
///
/// velocity error -> acceleration (limited) -> tilt and thrust -> attitude by a second-order loop with
/// limited rates. Rigid body, thrust along the body's z, drag linear in the speed through the air. The ground
/// (z = 0) carries it.
class Quadrotor {
 public:
  static constexpr double kGravity_mps2 = 9.81;

  /// Starts at rest, trimmed for `wind_odom_mps` (if it does not stand on the ground).
  Quadrotor(const VehicleParams& params, const Eigen::Isometry3d& T_odom_base,
            const Eigen::Vector3d& wind_odom_mps = Eigen::Vector3d::Zero());

  /// A command that is not finite is ignored, as a lost one would be.
  void command(const VelocityCommand& command);

  /// Moves on by `step_sec`, in which the air moves with `wind_odom_mps`.
  void step(double step_sec, const Eigen::Vector3d& wind_odom_mps);

  const VehicleTruth& truth() const { return truth_; }
  /// What an accelerometer feels: at rest +g on z [m/s^2].
  Eigen::Vector3d specificForceBase() const { return specific_force_base_mps2_; }

 private:
  Eigen::Vector3d wantedForce(double step_sec);
  void turn(const Eigen::Vector3d& force, double step_sec);
  void move(const Eigen::Vector3d& force, const Eigen::Vector3d& wind_odom_mps, double step_sec);
  void standOnGround();

  VehicleParams params_;
  VehicleTruth truth_;
  VelocityCommand command_;
  double command_age_sec_ = 0.0;
  double thrust_mps2_ = kGravity_mps2;
  Eigen::Vector3d trim_mps2_ = Eigen::Vector3d::Zero();  // integral of the velocity error
  Eigen::Vector3d specific_force_base_mps2_ = Eigen::Vector3d(0, 0, kGravity_mps2);
};

}  // namespace window_ingress::simulation
