#pragma once

#include <geometry_msgs/Twist.h>

#include <limits>
#include <optional>
#include <string>

#include "window_ingress/configuration/guard_params.hpp"

namespace window_ingress::adapters {

using configuration::GuardParams;

/// Why this velocity must not reach the autopilot; empty if it may.
std::string whyUnsafe(const geometry_msgs::Twist& twist, const GuardParams& params);

/// What the last gate lets through: the input while it is recent and sane, zero in every other case, and
/// nothing at all once sane input has been missing for too long. No clock: times are seconds of the steady
/// one.
///
/// - before the first sane input: zero, for as long as that takes. An autopilot wants a stream before it may
///   be told to follow it.
/// - input up to `late_sec` old: the input, or zero if it is not finite or beyond the limits
/// - older: zero, so that the vehicle brakes; an autopilot that holds the last velocity (ArduPilot: 3 s)
///   would fly on
/// - no sane input for `stop_streaming_after_sec` more: nothing. Velocity zero is no place to stay: it drifts
///   with the error of the autopilot's own velocity, some centimetres a second. The default leaves the time
///   to brake from 1.5 m/s (2 s, 1.2 m) and for a pilot to take over, and drifts less than half a metre.
/// - the next sane input begins all this anew
class SetpointGate {
 public:
  explicit SetpointGate(const GuardParams& params) : params_(params) {}

  void receive(const geometry_msgs::Twist& twist, double now_sec);
  /// \return what to send now; nothing: send nothing
  std::optional<geometry_msgs::Twist> output(double now_sec) const;

  bool isLate(double now_sec) const { return !(now_sec - received_sec_ <= params_.late_sec); }
  bool isSilent(double now_sec) const;  ///< nothing is sent
  /// Why the last input is refused; empty if it is not.
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
