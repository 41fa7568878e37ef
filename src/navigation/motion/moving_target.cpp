#include "navigation/motion/moving_target.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {

TargetEstimate ahead(const TargetEstimate& target, double at_sec) {
  const estimation::MotionModel& model = target.motion.model;
  if (model.stands()) return target;
  const double elapsed_sec = at_sec - target.pose_stamp_sec;
  const auto passed = model.over(elapsed_sec);
  TargetEstimate later = target;
  later.pose_stamp_sec = std::max(at_sec, target.pose_stamp_sec);
  later.T_odom_window.translation() += passed.way_sec * target.motion.velocity_odom_mps;
  later.motion.velocity_odom_mps *= passed.kept;
  const double sigma_mps = target.motion.velocity_sigma_mps;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma_m = std::sqrt(std::max(0.0, target.covariance(axis, axis)));
    later.covariance(axis, axis) = std::pow(sigmaAhead(sigma_m, target.motion, elapsed_sec), 2);
  }
  later.motion.velocity_sigma_mps = std::hypot(passed.kept * sigma_mps, std::sqrt(passed.velocity_variance));
  return later;
}

double sigmaAhead(double sigma_m, const estimation::TargetMotion& motion, double elapsed_sec) {
  const auto passed = motion.model.over(elapsed_sec);
  return std::hypot(sigma_m + passed.way_sec * motion.velocity_sigma_mps, std::sqrt(passed.place_variance));
}

double reachM(const estimation::TargetMotion& motion) {
  constexpr double kSigmas = 2.0;  // from one side to the other
  return motion.model.stands() ? 0.0 : kSigmas * motion.model.speed_mps * motion.model.time_sec;
}

}  // namespace window_ingress::navigation
