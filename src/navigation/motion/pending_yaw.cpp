#include "navigation/motion/pending_yaw.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kMemorySec = 2.0;
constexpr double kMaxRad = 0.5;  // a second at the usual limit

}  // namespace

void PendingYaw::update(double heading_rad, double told_radps, double dt_sec) {
  if (!std::isfinite(heading_rad) || !std::isfinite(told_radps) || !(dt_sec >= 0.0)) return;
  if (last_heading_rad_) {
    const double turned_rad = geometry::wrapAngle(heading_rad - *last_heading_rad_);
    const double kept_rad = to_come_rad_ * std::exp(-dt_sec / kMemorySec);
    to_come_rad_ = std::clamp(kept_rad + told_radps * dt_sec - turned_rad, -kMaxRad, kMaxRad);
  }
  last_heading_rad_ = heading_rad;
}

}  // namespace window_ingress::navigation
