#pragma once

#include <optional>

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
  void update(double heading_rad, double told_radps, double dt_sec);
  /// The heading begins anew with the next one.
  void reset() { *this = PendingYaw(); }
  /// Positive counter-clockwise [rad].
  double rad() const { return to_come_rad_; }

 private:
  std::optional<double> last_heading_rad_;
  double to_come_rad_ = 0.0;
};

}  // namespace window_ingress::navigation
