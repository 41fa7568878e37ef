#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "simulation/scenario/quadrotor_params.hpp"

namespace window_ingress::simulation {

/// The vector, shortened to the length `longest` if it is longer.
inline Eigen::Vector3d shortened(const Eigen::Vector3d& v, double longest) {
  const double length = v.norm();
  return length > longest ? Eigen::Vector3d(v * (longest / length)) : v;
}

/// An autopilot's conversion of a velocity setpoint into an acceleration, in each step, for all axes:
///
///     r' = a,  a -> (gain * setpoint - r) / setpoint_time_constant, limited in size and in change
///     e' = r - v
///     acceleration = feed_forward * a + (r + hold * e - v) / velocity_time_constant + trim
///     trim' = integral / velocity_time_constant * (r - v)
///
/// r is the shaped setpoint, e the vehicle's lag behind the position to which r leads, v the vehicle's
/// estimated velocity. Without shaping limits, r is the setpoint. The trim is frozen while the acceleration
/// is at its limit, and learns less from errors beyond 0.3 m/s, to limit wind-up.
class VelocityController {
 public:
  explicit VelocityController(const QuadrotorParams& params) : params_(params) {}

  /// The wanted acceleration, including `trim()` [m/s^2].
  Eigen::Vector3d step(const Eigen::Vector3d& setpoint_mps, const Eigen::Vector3d& velocity_mps,
                       double step_sec) {
    shape(params_.velocity_gain * setpoint_mps, step_sec);
    const Eigen::Vector3d error = reference_mps_ - velocity_mps;
    lag_m_ = shortened(lag_m_ + step_sec * error, kLongestLag_m);
    const Eigen::Vector3d wish =
        params_.acceleration_feed_forward * reference_mps2_ +
        (error + params_.position_hold_per_sec * lag_m_) / params_.velocity_time_constant_sec;
    const Eigen::Vector3d limited = shortened(wish, params_.max_acceleration_mps2);
    if (wish.isApprox(limited)) learnTrim(error, step_sec);
    Eigen::Vector3d asked = limited + trim_mps2_;
    // A trim learnt against an opposite pull must not prevent braking.
    const Eigen::Vector3d level(wish.x() + trim_mps2_.x(), wish.y() + trim_mps2_.y(), 0.0);
    asked.head<2>() = shortened(level, params_.max_acceleration_mps2).head<2>();
    return asked;
  }

  void setTrim(const Eigen::Vector3d& trim_mps2) { trim_mps2_ = trim_mps2; }
  /// Restarts at rest at the present place; keeps the trim.
  void restart() {
    reference_mps_.setZero();
    reference_mps2_.setZero();
    lag_m_.setZero();
  }

  const Eigen::Vector3d& trim() const { return trim_mps2_; }

 private:
  static double limitOr(double limit) {
    return limit > 0.0 ? limit : std::numeric_limits<double>::infinity();
  }

  static constexpr double kLongestLag_m = 1.0;      // with a larger lag, the place to return to moves along
  static constexpr double kNearSetpoint_mps = 0.3;  // beyond, the trim learns less, the larger the error

  // A step of the setpoint hardly changes the trim, but any lasting error is compensated in the end.
  void learnTrim(const Eigen::Vector3d& error_mps, double step_sec) {
    const double rate = params_.velocity_integral_per_sec / params_.velocity_time_constant_sec;
    const double trust =
        std::min(1.0, std::pow(kNearSetpoint_mps, 2) / std::max(error_mps.squaredNorm(), 1e-9));
    trim_mps2_ += rate * trust * step_sec * error_mps;
  }

  void shape(const Eigen::Vector3d& wanted_mps, double step_sec) {
    const double time_constant_sec = std::max(params_.setpoint_time_constant_sec, step_sec);
    const Eigen::Vector3d wish = shortened((wanted_mps - reference_mps_) / time_constant_sec,
                                           limitOr(params_.setpoint_acceleration_mps2));
    reference_mps2_ += shortened(wish - reference_mps2_, limitOr(params_.setpoint_jerk_mps3) * step_sec);
    reference_mps_ += step_sec * reference_mps2_;
  }

  QuadrotorParams params_;
  Eigen::Vector3d reference_mps_ = Eigen::Vector3d::Zero(), reference_mps2_ = Eigen::Vector3d::Zero(),
                  lag_m_ = Eigen::Vector3d::Zero(), trim_mps2_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::simulation
