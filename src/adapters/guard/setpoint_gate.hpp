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

  void receive(const geometry_msgs::Twist& twist, double now_sec);
  /// \return the message to send now; empty: send nothing
  std::optional<geometry_msgs::Twist> output(double now_sec) const;

  bool isLate(double now_sec) const { return !(now_sec - received_sec_ <= params_.late_sec); }
  bool isSilent(double now_sec) const;  ///< nothing is sent
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
