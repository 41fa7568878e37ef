#pragma once

#include <geometry_msgs/Twist.h>

#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "window_ingress/configuration/guard_params.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

using configuration::GuardParams;

/// Why this velocity must not reach the autopilot; empty if it may.
inline std::string whyUnsafe(const geometry_msgs::Twist& twist, const GuardParams& params) {
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

/// The rules of the last gate: recent, sane input passes; otherwise the output is zero, and after a longer
/// time without sane input there is no output. Has no clock: all times are seconds on the steady clock.
///
/// - before the first sane input: zero, without time limit, because an autopilot needs a stream before it can
///   be switched to follow it
/// - input up to `late_sec` old: the input, or zero if it is not finite or beyond the limits
/// - older input: zero, so that the vehicle brakes; an autopilot that holds the last velocity (for 3 s with
///   ArduPilot) would fly on
/// - no sane input for `stop_streaming_after_sec` more: no output, because zero velocity does not hold a
///   place: the vehicle drifts with the error of the autopilot's velocity, some centimetres a second. The
///   default leaves time to brake from 1.5 m/s (2 s, 1.2 m) and for a pilot to take over; the drift is less
///   than half a metre.
/// - the next sane input restarts the rules
class SetpointGate {
 public:
  explicit SetpointGate(const GuardParams& params) : params_(params) {}

  void receive(const geometry_msgs::Twist& twist, double now_sec) {
    input_ = twist;
    received_sec_ = now_sec;
    fault_ = whyUnsafe(twist, params_);
    if (fault_.empty()) sane_sec_ = now_sec;
  }

  /// \return the message to send now; empty: send nothing
  std::optional<geometry_msgs::Twist> output(double now_sec) const {
    if (isSilent(now_sec)) return std::nullopt;
    return isLate(now_sec) || !fault_.empty() ? geometry_msgs::Twist() : input_;
  }

  bool isLate(double now_sec) const { return !(now_sec - received_sec_ <= params_.late_sec); }
  /// Whether nothing is sent.
  bool isSilent(double now_sec) const {
    const bool ends = params_.stop_streaming_after_sec > 0.0 && std::isfinite(sane_sec_);
    return ends && sinceSaneSec(now_sec) > params_.late_sec + params_.stop_streaming_after_sec;
  }

  /// Why the last input was refused; empty if it was not.
  const std::string& fault() const { return fault_; }
  double sinceSaneSec(double now_sec) const { return now_sec - sane_sec_; }

 private:
  GuardParams params_;
  geometry_msgs::Twist input_;
  std::string fault_;
  double received_sec_ = -std::numeric_limits<double>::infinity();
  double sane_sec_ = -std::numeric_limits<double>::infinity();
};

}  // namespace window_ingress::adapters
