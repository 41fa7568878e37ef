#pragma once

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// Predicts a moving window: its place continues with its decaying velocity, and its covariance grows, with
/// errors of place and velocity assumed to have the same sign. A window that stands still is returned
/// unchanged.
TargetEstimate ahead(const TargetEstimate& target, double at_sec);

/// Standard deviation [m] after this time, along one axis, of a place known to `sigma_m` now.
double sigmaAhead(double sigma_m, const estimation::TargetMotion& motion, double elapsed_sec);

/// How far a moving window may be from where it was seen before [m].
double reachM(const estimation::TargetMotion& motion);

}  // namespace window_ingress::navigation
