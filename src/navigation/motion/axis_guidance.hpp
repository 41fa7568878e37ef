/// Velocities that lead onto the window's axis.
#pragma once

#include <Eigen/Core>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation {

/// Forward velocity less the wind's component towards the window; headwind is not compensated.
double againstTailwind(double forward_mps, const TargetEstimate& target, const Situation& situation);

/// Yaw rate that removes the heading error, less the yaw that is already commanded.
double yawRateFor(double error_rad, const Situation& situation, const NavigatorParams& params);

/// Velocity along one axis that removes the error (goal minus present): proportional to small errors, limited
/// to the speed from which the vehicle can stop for large ones (square-root controller, as in autopilots).
double velocityTowards(double error_m, double limit_mps, const NavigatorParams& params);

/// Velocity in odom axes: the given forward speed, plus motion across onto the window's axis and against the
/// wind, within the speed limit. Priority: away from the window, then across, then forward.
Eigen::Vector3d velocityAlongAxis(const RelativeState& relative, const TargetEstimate& target,
                                  double forward_mps, const Eigen::Vector3d& wind_odom_mps,
                                  const NavigatorParams& params);

}  // namespace window_ingress::navigation
