#pragma once

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// Where the window will be, and how well that is known then: its place goes on with its velocity, which is
/// forgotten, and its covariance grows, errors of place and velocity taken to be of one sign. One that stands
/// still is returned as it is.
TargetEstimate ahead(const TargetEstimate& target, double at_sec);

/// Standard deviation of a place along one axis that is known to `sigma_m` now [m].
double sigmaAhead(double sigma_m, const estimation::TargetMotion& motion, double elapsed_sec);

/// How far the window may be from where it was seen before, for that it moves [m].
double reachM(const estimation::TargetMotion& motion);

}  // namespace window_ingress::navigation
