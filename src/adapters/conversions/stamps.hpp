/// Time stamps of messages, compared as doubles: the difference of two `ros::Time` throws beyond 2^31 s.
#pragma once

#include <ros/time.h>

#include <cstdint>
#include <limits>
#include <optional>

namespace window_ingress::adapters {

/// Seconds of a stamp; empty if it is zero (unstamped) or its nanoseconds are not below 1e9.
inline std::optional<double> stampSec(const ros::Time& stamp) {
  if (stamp.isZero() || stamp.nsec >= 1000000000u) return std::nullopt;
  return stamp.toSec();
}

/// The nearest stamp for a time in seconds; zero if no stamp can hold it.
inline ros::Time toStamp(double sec) {
  constexpr double kEnd = std::numeric_limits<std::uint32_t>::max();
  return sec >= 0.0 && sec < kEnd ? ros::Time(sec) : ros::Time();
}

}  // namespace window_ingress::adapters
