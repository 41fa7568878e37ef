#include "adapters/guard/setpoint_gate.hpp"

#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

std::string whyUnsafe(const geometry_msgs::Twist& twist, const GuardParams& params) {
  const auto &v = twist.linear, &w = twist.angular;
  // Checked one by one, because std::hypot of three numbers swallows a NaN beside zeros.
  for (const double number : {v.x, v.y, v.z, w.x, w.y, w.z})
    if (!std::isfinite(number)) return "velocity is not finite";
  const double speed = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
  const double turning = std::sqrt(w.x * w.x + w.y * w.y + w.z * w.z);
  if (!(speed <= params.max_speed_mps))
    return formatted("speed of %.2f m/s is above the limit, max_speed_mps: %.2f", speed,
                     params.max_speed_mps);
  if (!(turning <= params.max_yaw_rate_radps))
    return formatted("turning at %.2f rad/s is above the limit, max_yaw_rate_radps: %.2f", turning,
                     params.max_yaw_rate_radps);
  return "";
}

void SetpointGate::receive(const geometry_msgs::Twist& twist, double now_sec) {
  input_ = twist;
  received_sec_ = now_sec;
  fault_ = whyUnsafe(twist, params_);
  if (fault_.empty()) sane_sec_ = now_sec;
}

bool SetpointGate::isSilent(double now_sec) const {
  const bool ends = params_.stop_streaming_after_sec > 0.0 && std::isfinite(sane_sec_);
  return ends && sinceSaneSec(now_sec) > params_.late_sec + params_.stop_streaming_after_sec;
}

std::optional<geometry_msgs::Twist> SetpointGate::output(double now_sec) const {
  if (isSilent(now_sec)) return std::nullopt;
  return isLate(now_sec) || !fault_.empty() ? geometry_msgs::Twist() : input_;
}

}  // namespace window_ingress::adapters
