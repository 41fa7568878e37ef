#pragma once

#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// The last gate: whatever is wished, what comes out is finite and within speed, acceleration, jerk, yaw rate
/// and yaw acceleration. Changes are measured against the setpoint before; `stop` and `cutTo` are the
/// exceptions, they only take velocity away.
class SetpointLimiter {
 public:
  explicit SetpointLimiter(const LimitParams& limits) : limits_(limits) {}

  /// \param dt_sec since the setpoint before; not finite or negative counts as 0, more than 0.2 s as 0.2 s
  /// \return zero at once if anything of the wish is not finite
  Setpoint limit(const Setpoint& wish, double dt_sec);

  /// Zero at once, not by a ramp.
  Setpoint stop();

  /// Replaces the setpoint just given by one that is no faster.
  Setpoint cutTo(const Setpoint& setpoint);

 private:
  const Eigen::Vector3d& accelerated(const Eigen::Vector3d& way_mps, double dt_sec);

  LimitParams limits_;
  Setpoint last_;
  Eigen::Vector3d acceleration_mps2_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::navigation
