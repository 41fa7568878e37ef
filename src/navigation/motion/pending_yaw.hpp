#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {

/// How far the vehicle has been told to turn and has not turned yet.
///
/// An autopilot answers a yaw rate late, and goes on turning when it is told to stop: it turns after the
/// heading that the rates add up to. Who steers by the heading measured now tells it to turn twice, and
/// swings. Less what is still to come, the error is that of the heading that is asked for already, whatever
/// the delay.
///
/// What has not come after a while does not come any more: rates are not followed exactly, and wind turns,
/// too.
class PendingYaw {
 public:
  /// \param told_radps the yaw rate in force since the last step
  void update(double heading_rad, double told_radps, double dt_sec) {
    if (!std::isfinite(heading_rad) || !std::isfinite(told_radps) || !(dt_sec >= 0.0)) return;
    if (last_heading_rad_) {
      const double turned_rad = geometry::wrapAngle(heading_rad - *last_heading_rad_);
      const double kept_rad = to_come_rad_ * std::exp(-dt_sec / kMemorySec);
      to_come_rad_ = std::clamp(kept_rad + told_radps * dt_sec - turned_rad, -kMaxRad, kMaxRad);
    }
    last_heading_rad_ = heading_rad;
  }

  /// The heading begins anew with the next one.
  void reset() { *this = PendingYaw(); }
  /// Positive counter-clockwise [rad].
  double rad() const { return to_come_rad_; }

 private:
  static constexpr double kMemorySec = 2.0;
  static constexpr double kMaxRad = 0.5;  // a second at the usual limit

  std::optional<double> last_heading_rad_;
  double to_come_rad_ = 0.0;
};

}  // namespace window_ingress::navigation
