#include "navigation/motion/axis_guidance.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {
namespace {

// The forward speed may rise by this share of its gain per response time; by more below kMuchAcrossMps.
constexpr double kShareAhead = 1.25, kMuchAcrossMps = 0.3;

/// Limit [m/s] on the rise of the forward speed while the velocity across must change by `across_mps`: a
/// vehicle with little acceleration would spend it on forward flight and miss the opening's axis.
double aheadMps(double across_mps, const NavigatorParams& params) {
  const double in_its_response_mps = params.vehicle.braking_mps2 * params.vehicle.response_sec;
  return kShareAhead * in_its_response_mps * std::max(1.0, kMuchAcrossMps / std::max(1e-3, across_mps));
}

}  // namespace

double againstTailwind(double forward_mps, const TargetEstimate& target, const Situation& situation) {
  return forward_mps - std::max(0.0, normalOf(target).dot(situation.wind_odom_mps));
}

double yawRateFor(double error_rad, const Situation& situation, const NavigatorParams& params) {
  const double limit = params.limits.yaw_rate_radps;
  return std::clamp(params.align.yaw_gain_hz * (error_rad - situation.pending_yaw_rad), -limit, limit);
}

double velocityTowards(double error_m, double limit_mps, const NavigatorParams& params) {
  const double gain_hz = params.align.lateral_gain_hz, braking_mps2 = params.vehicle.braking_mps2;
  const double linear_m = braking_mps2 / (gain_hz * gain_hz);
  const double way_m = std::abs(error_m);
  const double speed_mps =
      way_m <= linear_m ? gain_hz * way_m : std::sqrt(2.0 * braking_mps2 * (way_m - 0.5 * linear_m));
  return std::copysign(std::min(speed_mps, limit_mps), error_m);
}

Eigen::Vector3d velocityAlongAxis(const RelativeState& relative, const TargetEstimate& target,
                                  double forward_mps, const Eigen::Vector3d& wind_odom_mps,
                                  const NavigatorParams& params) {
  const Eigen::Vector3d coasted = relative.coastedM(params.vehicle);
  const auto& align = params.align;
  Eigen::Vector3d velocity_window(0.0, velocityTowards(-coasted.y(), align.lateral_speed_mps, params),
                                  velocityTowards(-coasted.z(), align.vertical_speed_mps, params));
  const Eigen::Matrix3d R_odom_window = uprightRotation(target);
  const Eigen::Vector3d carried_window =
      R_odom_window.transpose() * (target.motion.velocity_odom_mps - wind_odom_mps);
  velocity_window.tail<2>() += carried_window.tail<2>();
  const double limit_mps = params.limits.speed_mps, wished_mps = std::max(forward_mps, -limit_mps);
  const auto leftBeside = [&](double taken_mps) {
    return std::sqrt(std::max(0.0, limit_mps * limit_mps - taken_mps * taken_mps));
  };
  const double across_mps = velocity_window.norm(), most_mps = leftBeside(std::min(0.0, wished_mps));
  if (across_mps > most_mps) velocity_window *= most_mps / across_mps;
  const double ahead_mps =
      std::max(0.0, relative.velocity_window_mps.x()) +
      aheadMps((velocity_window - relative.velocity_window_mps).tail<2>().norm(), params);
  velocity_window.x() = std::min({wished_mps, ahead_mps, leftBeside(velocity_window.norm())});
  return R_odom_window * velocity_window;
}

}  // namespace window_ingress::navigation
