#pragma once

#include <ros/time.h>

#include <algorithm>
#include <optional>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

using navigation::StampLimits;

/// Detects a clock that jumps back: a looped bag, or a simulation that was reset.
class ClockWatch {
 public:
  /// \return true once for each jump back by more than 0.1 s
  bool jumpedBack(double now_sec) {
    const bool back = now_sec < last_sec_ - 0.1;
    last_sec_ = now_sec;
    return back;
  }

 private:
  double last_sec_ = 0.0;
};

/// Admits messages of one topic by their stamp: not zero, recent, and newer than the previous one. Restarts
/// when the clock jumps back.
class StampGate {
 public:
  explicit StampGate(const StampLimits& limits) : limits_(limits) {}

  /// \return empty if the message is admitted, else the reason with numbers
  std::optional<std::string> whyRefused(const ros::Time& stamp, double now_sec) {
    const std::optional<double> sec = stampSec(stamp);
    if (!sec) return "header.stamp is zero or not normalised; the source must stamp its messages";
    const double age_sec = now_sec - *sec;
    if (age_sec > 86400.0)
      return formatted(
          "stamp is %.0f days old; recorded data? then set use_sim_time and play with --clock (limit %.2f s)",
          age_sec / 86400.0, limits_.max_age_sec);
    if (age_sec > limits_.max_age_sec)
      return formatted("stamp is %.2f s old, limit %.2f s", age_sec, limits_.max_age_sec);
    if (now_sec <= 0.0 && -age_sec > std::min(limits_.max_future_sec, 86400.0))
      return "the clock has not begun: nothing has come on /clock yet";
    if (-age_sec > 86400.0)
      return formatted(
          "stamp is %.0f days ahead of the clock; is use_sim_time set beside a real source? (limit %.2f s)",
          -age_sec / 86400.0, limits_.max_future_sec);
    if (-age_sec > limits_.max_future_sec)
      return formatted("stamp is %.2f s ahead of the clock, limit %.2f s", -age_sec, limits_.max_future_sec) +
             (ros::Time::isSimTime() ? kSlowPlayer : "");
    if (clock_.jumpedBack(now_sec)) last_sec_.reset();
    if (last_sec_ && *sec <= *last_sec_)
      return formatted("stamp %.3f is not after the previous one, %.3f", *sec, *last_sec_);
    last_sec_ = sec;
    return std::nullopt;
  }

 private:
  // A player publishes no clock while it unpacks a chunk of the bag, and then sends all due messages at once.
  static constexpr const char* kSlowPlayer =
      "; if a bag is played, its player is too slow: rosbag decompress the bag, or play at rate:=0.3";

  StampLimits limits_;
  ClockWatch clock_;
  std::optional<double> last_sec_;
};

}  // namespace window_ingress::adapters
