#include "adapters/conversions/stamps.hpp"

#include <cmath>
#include <limits>

namespace window_ingress::adapters {

std::optional<double> stampSec(const ros::Time& stamp) {
  if (stamp.isZero() || stamp.nsec >= 1000000000u) return std::nullopt;
  return stamp.toSec();
}

ros::Time toStamp(double sec) {
  constexpr double kEnd = std::numeric_limits<std::uint32_t>::max();
  if (!(sec >= 0.0) || sec >= kEnd) return ros::Time();
  const double whole = std::floor(sec);
  const auto nsec = static_cast<std::uint64_t>(std::llround((sec - whole) * 1e9));
  const auto carry = static_cast<std::uint32_t>(nsec / 1000000000u);
  return ros::Time(static_cast<std::uint32_t>(whole) + carry, static_cast<std::uint32_t>(nsec % 1000000000u));
}

}  // namespace window_ingress::adapters
