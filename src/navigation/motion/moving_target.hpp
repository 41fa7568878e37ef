#pragma once

#include <algorithm>
#include <cmath>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// Standard deviation [m] after this time, along one axis, of a place known to `sigma_m` now.
inline double sigmaAhead(double sigma_m, const estimation::TargetMotion& motion, double elapsed_sec) {
  const auto passed = motion.model.over(elapsed_sec);
  return std::hypot(sigma_m + passed.way_sec * motion.velocity_sigma_mps, std::sqrt(passed.place_variance));
}

/// Predicts a moving window: its place continues with its decaying velocity, and its covariance grows, with
/// errors of place and velocity assumed to have the same sign. A window that stands still is returned
/// unchanged.
inline TargetEstimate ahead(const TargetEstimate& target, double at_sec) {
  if (target.motion.model.stands()) return target;
  const double elapsed_sec = at_sec - target.pose_stamp_sec;
  const auto passed = target.motion.model.over(elapsed_sec);
  TargetEstimate later = target;
  later.pose_stamp_sec = std::max(at_sec, target.pose_stamp_sec);
  later.T_odom_window.translation() += passed.way_sec * target.motion.velocity_odom_mps;
  later.motion.velocity_odom_mps *= passed.kept;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma_m = std::sqrt(std::max(0.0, target.covariance(axis, axis)));
    later.covariance(axis, axis) = std::pow(sigmaAhead(sigma_m, target.motion, elapsed_sec), 2);
  }
  later.motion.velocity_sigma_mps =
      std::hypot(passed.kept * target.motion.velocity_sigma_mps, std::sqrt(passed.velocity_variance));
  return later;
}

/// How far a moving window may be from where it was seen before [m].
inline double reachM(const estimation::TargetMotion& motion) {
  constexpr double kSigmas = 2.0;  // from one side to the other
  return motion.model.stands() ? 0.0 : kSigmas * motion.model.speed_mps * motion.model.time_sec;
}

}  // namespace window_ingress::navigation
