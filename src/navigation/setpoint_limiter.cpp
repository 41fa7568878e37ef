#include "window_ingress/navigation/setpoint_limiter.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {
namespace {

bool isFinite(const Setpoint& setpoint) {
  return setpoint.velocity_odom_mps.allFinite() && std::isfinite(setpoint.yaw_rate_radps);
}

Eigen::Vector3d shortenedTo(double length, const Eigen::Vector3d& vector) {
  const double norm = vector.stableNorm();
  return norm > length ? Eigen::Vector3d(vector * (length / norm)) : vector;
}

}  // namespace

Setpoint SetpointLimiter::limit(const Setpoint& wish, double dt_sec) {
  if (!isFinite(wish)) return stop();
  const double dt = std::isfinite(dt_sec) ? std::clamp(dt_sec, 0.0, 0.2) : 0.0;
  const Eigen::Vector3d wanted = shortenedTo(limits_.speed_mps, wish.velocity_odom_mps);
  const double wanted_rate = std::clamp(wish.yaw_rate_radps, -limits_.yaw_rate_radps, limits_.yaw_rate_radps);
  const double rate_step = limits_.yaw_acceleration_radps2 * dt;
  last_.velocity_odom_mps += shortenedTo(limits_.acceleration_mps2 * dt, wanted - last_.velocity_odom_mps);
  last_.yaw_rate_radps += std::clamp(wanted_rate - last_.yaw_rate_radps, -rate_step, rate_step);
  return isFinite(last_) ? last_ : stop();
}

Setpoint SetpointLimiter::stop() {
  last_ = Setpoint();
  return last_;
}

Setpoint SetpointLimiter::cutTo(const Setpoint& setpoint) {
  const bool is_slower = isFinite(setpoint) &&
                         setpoint.velocity_odom_mps.norm() <= last_.velocity_odom_mps.norm() + 1e-12 &&
                         std::abs(setpoint.yaw_rate_radps) <= std::abs(last_.yaw_rate_radps) + 1e-12;
  if (!is_slower) return stop();
  last_ = setpoint;
  return last_;
}

}  // namespace window_ingress::navigation
