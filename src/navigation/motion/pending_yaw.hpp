#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {

/// Yaw that was commanded but has not been turned yet.
///
/// An autopilot answers a yaw rate late and keeps turning when told to stop, because it follows the integral
/// of the commanded rates. A controller that uses only the measured heading commands the turn twice and
/// oscillates. Subtracting the pending yaw gives the error of the commanded heading, whatever the delay.
///
/// Pending yaw decays with time: rates are not followed exactly, and wind turns the vehicle as well.
class PendingYaw {
 public:
  /// \param told_radps the yaw rate commanded since the last step
  void update(double heading_rad, double told_radps, double dt_sec) {
    if (!std::isfinite(heading_rad) || !std::isfinite(told_radps) || !(dt_sec >= 0.0)) return;
    if (last_heading_rad_) {
      const double turned_rad = geometry::wrapAngle(heading_rad - *last_heading_rad_);
      const double kept_rad = to_come_rad_ * std::exp(-dt_sec / kMemorySec);
      to_come_rad_ = std::clamp(kept_rad + told_radps * dt_sec - turned_rad, -kMaxRad, kMaxRad);
    }
    last_heading_rad_ = heading_rad;
  }

  /// Restarts with the next heading.
  void reset() { *this = PendingYaw(); }
  /// Pending yaw, positive counter-clockwise [rad].
  double rad() const { return to_come_rad_; }

 private:
  static constexpr double kMemorySec = 2.0;
  static constexpr double kMaxRad = 0.5;  // one second at the usual limit

  std::optional<double> last_heading_rad_;
  double to_come_rad_ = 0.0;
};

}  // namespace window_ingress::navigation
