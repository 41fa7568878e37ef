#pragma once

#include <Eigen/Core>

#include "simulation/scenario/quadrotor_params.hpp"

namespace window_ingress::simulation {

/// The vector, made `longest` long if it is longer.
Eigen::Vector3d shortened(const Eigen::Vector3d& v, double longest);

/// How an autopilot turns a velocity setpoint into an acceleration, each step and all axes alike:
///
///     r' = a,  a -> (gain * setpoint - r) / setpoint_time_constant, limited in size and in change
///     e' = r - v
///     acceleration = feed_forward * a + (r + hold * e - v) / velocity_time_constant + trim
///     trim' = integral / velocity_time_constant * (r - v)
///
/// r is the shaped setpoint, e how far the vehicle lags behind where r leads.
///
/// v is the velocity as the vehicle estimates it. Without limits of the shaping, r is the setpoint. The trim
/// rests while the acceleration is at its limit, and learns less from errors beyond 0.3 m/s: little wind-up.
class VelocityController {
 public:
  explicit VelocityController(const QuadrotorParams& params) : params_(params) {}

  /// The acceleration wanted, `trim()` included [m/s^2].
  Eigen::Vector3d step(const Eigen::Vector3d& setpoint_mps, const Eigen::Vector3d& velocity_mps,
                       double step_sec);
  void setTrim(const Eigen::Vector3d& trim_mps2) { trim_mps2_ = trim_mps2; }
  void restart();  ///< at rest where it is; keeps the trim
  const Eigen::Vector3d& trim() const { return trim_mps2_; }

 private:
  void learnTrim(const Eigen::Vector3d& error_mps, double step_sec);
  void shape(const Eigen::Vector3d& wanted_mps, double step_sec);

  QuadrotorParams params_;
  Eigen::Vector3d reference_mps_ = Eigen::Vector3d::Zero(), reference_mps2_ = Eigen::Vector3d::Zero(),
                  lag_m_ = Eigen::Vector3d::Zero(), trim_mps2_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::simulation
