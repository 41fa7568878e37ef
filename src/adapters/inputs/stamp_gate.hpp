#pragma once

#include <ros/time.h>

#include <optional>
#include <string>

#include "adapters/inputs/clock_watch.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::adapters {

using navigation::StampLimits;

/// Admits messages of one topic by their stamp: not zero, recent, and newer than the previous one. Restarts
/// when the clock jumps back.
class StampGate {
 public:
  explicit StampGate(const StampLimits& limits) : limits_(limits) {}

  /// \return empty if the message is admitted, else the reason with numbers
  std::optional<std::string> whyRefused(const ros::Time& stamp, double now_sec);

 private:
  StampLimits limits_;
  ClockWatch clock_;
  std::optional<double> last_sec_;
};

}  // namespace window_ingress::adapters
