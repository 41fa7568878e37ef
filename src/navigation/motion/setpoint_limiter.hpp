#pragma once

#include <algorithm>
#include <cmath>

#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// The last gate: whatever the input, the output is finite and within the limits of speed, acceleration,
/// jerk, yaw rate and yaw acceleration. Changes are measured against the previous setpoint. The exceptions
/// `stop` and `cutTo` only take velocity away.
class SetpointLimiter {
 public:
  explicit SetpointLimiter(const LimitParams& limits) : limits_(limits) {}

  /// \param dt_sec since the previous setpoint; not finite or negative counts as 0, more than 0.2 s as 0.2 s
  /// \return zero at once if any part of the wish is not finite
  Setpoint limit(const Setpoint& wish, double dt_sec) {
    if (!isFinite(wish)) return stop();
    const double dt = std::isfinite(dt_sec) ? std::clamp(dt_sec, 0.0, 0.2) : 0.0;
    const Eigen::Vector3d wanted = shortenedTo(limits_.speed_mps, wish.velocity_odom_mps);
    const double wanted_rate =
        std::clamp(wish.yaw_rate_radps, -limits_.yaw_rate_radps, limits_.yaw_rate_radps);
    const double rate_step = limits_.yaw_acceleration_radps2 * dt;
    last_.velocity_odom_mps += accelerated(wanted - last_.velocity_odom_mps, dt) * dt;
    last_.velocity_odom_mps = shortenedTo(limits_.speed_mps, last_.velocity_odom_mps);
    last_.yaw_rate_radps += std::clamp(wanted_rate - last_.yaw_rate_radps, -rate_step, rate_step);
    return isFinite(last_) ? last_ : stop();
  }

  /// Zero at once, without a ramp.
  Setpoint stop() {
    last_ = Setpoint();
    acceleration_mps2_.setZero();
    return last_;
  }

  /// Replaces the last setpoint by one that is no faster.
  Setpoint cutTo(const Setpoint& setpoint) {
    const bool is_slower = isFinite(setpoint) &&
                           setpoint.velocity_odom_mps.norm() <= last_.velocity_odom_mps.norm() + 1e-12 &&
                           std::abs(setpoint.yaw_rate_radps) <= std::abs(last_.yaw_rate_radps) + 1e-12;
    if (!is_slower) return stop();
    const Eigen::Vector3d cut = last_.velocity_odom_mps - setpoint.velocity_odom_mps;
    if (cut.norm() > 1e-9) {
      const Eigen::Vector3d direction = cut.normalized();
      acceleration_mps2_ -= std::max(0.0, acceleration_mps2_.dot(direction)) * direction;
    }
    last_ = setpoint;
    return last_;
  }

 private:
  static bool isFinite(const Setpoint& setpoint) {
    return setpoint.velocity_odom_mps.allFinite() && std::isfinite(setpoint.yaw_rate_radps);
  }

  static Eigen::Vector3d shortenedTo(double length, const Eigen::Vector3d& vector) {
    const double norm = vector.stableNorm();
    return norm > length ? Eigen::Vector3d(vector * (length / norm)) : vector;
  }

  // Largest acceleration that can still end at the wish: a^2 / (2 jerk) = way.
  const Eigen::Vector3d& accelerated(const Eigen::Vector3d& way_mps, double dt_sec) {
    const double way = way_mps.norm();
    if (!(dt_sec > 0.0)) return acceleration_mps2_;
    const double most =
        std::min({limits_.acceleration_mps2, std::sqrt(2.0 * limits_.jerk_mps3 * way), way / dt_sec});
    const Eigen::Vector3d wanted = way > 0.0 ? Eigen::Vector3d(way_mps * (most / way)) : way_mps;
    acceleration_mps2_ += shortenedTo(limits_.jerk_mps3 * dt_sec, wanted - acceleration_mps2_);
    return acceleration_mps2_;
  }

  LimitParams limits_;
  Setpoint last_;
  Eigen::Vector3d acceleration_mps2_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::navigation
