#include "navigation/behaviours/behaviour.hpp"

#include <algorithm>
#include <cmath>

#include "navigation/mission/opening_policy.hpp"
#include "navigation/mission/window_choice.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

/// With a larger difference between position and velocity, neither is reliable without sight of the window.
constexpr double kMaxDisagreementMps = 0.35;
constexpr double kMaxUnexplainedMps = 0.08;  // until a steady velocity bias can be told from a slide

// The forward speed may rise by this share of its gain per response time; by more below kMuchAcrossMps.
constexpr double kShareAhead = 1.25, kMuchAcrossMps = 0.3;

std::string whyNoOdometryToCommitBy(const OdometryQuality& odometry) {
  if (odometry.disagreement_mps > kMaxDisagreementMps)
    return formatted("odometry: position and velocity disagree by %.2f m/s", odometry.disagreement_mps);
  if (!odometry.is_bias_known && odometry.unexplained_mps > kMaxUnexplainedMps)
    return formatted("odometry: its velocity is off by %.2f m/s, not yet known to be a constant bias",
                     odometry.unexplained_mps);
  return "";
}

/// Limit [m/s] on the rise of the forward speed while the velocity across must change by `across_mps`: a
/// vehicle with little acceleration would spend it on forward flight and miss the opening's axis.
double aheadMps(double across_mps, const NavigatorParams& params) {
  const double in_its_response_mps = params.vehicle.braking_mps2 * params.vehicle.response_sec;
  return kShareAhead * in_its_response_mps * std::max(1.0, kMuchAcrossMps / std::max(1e-3, across_mps));
}

}  // namespace

void MissionState::leaveWindow() {
  trusted.reset();
  window_odom_m.reset();
  opening_asked = opening_confirmed = false;
}

void MissionState::giveUpWindow(const TargetEstimate& window) {
  left_odom_m.push_back(window.T_odom_window.translation());
  if (window.window_id != 0) given_up.push_back(window.window_id);
  leaveWindow();
}

void MissionState::forgetWindow() {
  leaveWindow();
  others_odom_m.clear();
}

void MissionState::forgetPlaces() {
  forgetWindow();
  committed.reset();
  left_odom_m.clear();
  home_odom_m.reset();
  place_odom_m.reset();
  keeping_since_sec.reset();
}

void MissionState::followVehicle(const Eigen::Vector3d& position_odom_m, const Eigen::Vector3d& carried_m) {
  if (!home_odom_m) home_odom_m = position_odom_m - from_home_m;
  from_home_m = position_odom_m - *home_odom_m;
  if (place_odom_m) *place_odom_m += carried_m - place_carried_m;
  place_carried_m = carried_m;
}

double heldSec(bool condition, double now_sec, std::optional<double>& since_sec) {
  if (!condition) since_sec.reset();
  if (condition && !since_sec) since_sec = now_sec;
  return since_sec ? now_sec - *since_sec : -1.0;
}

std::optional<Decision> leaveOtherWindow(const Situation& situation, MissionState& mission) {
  const auto& target = *situation.target;
  if (!target.other_window) {
    const std::string closed = whyClosed(target);
    if (closed.empty()) return std::nullopt;
    mission.giveUpWindow(target);
    return Decision{{}, true, Event::kOtherWindow, closed};
  }
  const Eigen::Vector3d position = situation.vehicle->T_odom_base.translation();
  mission.others_odom_m.push_back(position +
                                  *target.other_window * (target.T_odom_window.translation() - position));
  ++mission.others;
  if (target.window_id != 0) mission.given_up.push_back(target.window_id);
  mission.leaveWindow();
  return Decision{{}, true, Event::kOtherWindow, target.approach_forbidden};
}

bool isKnownOther(const TargetEstimate& target, const VehicleState& vehicle, const MissionState& mission) {
  if (wasLeftForGood(target, mission)) return true;
  constexpr double kSameDirectionRad = 0.12;
  const Eigen::Vector3d position = vehicle.T_odom_base.translation();
  const Eigen::Vector3d sight = (target.T_odom_window.translation() - position).normalized();
  return std::any_of(mission.others_odom_m.begin(), mission.others_odom_m.end(),
                     [&](const Eigen::Vector3d& other) {
                       return sight.dot((other - position).normalized()) > std::cos(kSameDirectionRad);
                     });
}

CommitCriterion criterionWith(const TargetEstimate& target, const Situation& situation,
                              const MissionState& mission, const NavigatorParams& params, double unseen_sec) {
  const Eigen::Matrix3d R_odom_window = uprightRotation(target);
  const auto gustAlong = [&](int axis) {
    const Eigen::Vector3d direction = R_odom_window.col(axis);
    return std::sqrt(std::max(0.0, direction.dot(situation.gusts_odom * direction)));
  };
  CommitCriterionInput input;
  input.relative = relate(*situation.vehicle, target);
  input.opening = target.opening;
  input.pitch_rad = pitchOf(*situation.vehicle);
  input.unseen_sec = unseen_sec;
  input.motion = target.motion;
  input.gusts_mps = {gustAlong(1), gustAlong(2)};
  input.gusts_watched_sec = situation.gusts_watched_sec;
  input.odometry_mps = situation.odometry.unexplained_mps;
  input.drift_m_per_sqrt_sec = situation.odometry.drift_m_per_sqrt_sec;
  CommitCriterion criterion = evaluateCommitCriterion(input, params);
  const std::string why_not = whyNotEntered(target, mission, params.commit);
  criterion.opening_unverified = !why_not.empty();
  if (criterion.holds) criterion.unmet = whyNoOdometryToCommitBy(situation.odometry);
  if (criterion.unmet.empty()) criterion.unmet = target.unverified;
  if (criterion.unmet.empty()) criterion.unmet = why_not;
  criterion.holds = criterion.unmet.empty();
  return criterion;
}

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
