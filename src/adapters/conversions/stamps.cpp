#include "adapters/conversions/stamps.hpp"

#include <cstdint>
#include <limits>

namespace window_ingress::adapters {

std::optional<double> stampSec(const ros::Time& stamp) {
  if (stamp.isZero() || stamp.nsec >= 1000000000u) return std::nullopt;
  return stamp.toSec();
}

ros::Time toStamp(double sec) {
  constexpr double kEnd = std::numeric_limits<std::uint32_t>::max();
  return sec >= 0.0 && sec < kEnd ? ros::Time(sec) : ros::Time();
}

}  // namespace window_ingress::adapters
