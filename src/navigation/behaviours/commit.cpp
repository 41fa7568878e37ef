#include <algorithm>

#include "navigation/behaviours/behaviours.hpp"
#include "navigation/mission/opening_policy.hpp"
#include "navigation/motion/moving_target.hpp"
#include "navigation/motion/stopping.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

constexpr int kInARow = 3;                // consecutive sightings that agree are believed
constexpr double kMaxUpdateJumpM = 0.15;  // updates further from the place at the commit are ignored
constexpr double kStoppedMps = 0.15;
constexpr double kReserve = 2.0;     // stopping distances needed to turn back after the point of no return
constexpr double kLeftOfExit = 0.4;  // of the exit distance: standing this near to its end is enough

/// The predicted miss, or the systematic offset at the plane, exceeds the clearance by half of the vehicle's
/// margin. A smaller excess is no reason to turn back.
bool isBroken(const CommitCriterion& criterion, const NavigatorParams& params) {
  const double given_m = params.vehicle.margin_m / 2.0;
  return std::max(criterion.miss_lateral_m, criterion.settled_lateral_m) >
             criterion.clearance_lateral_m + given_m ||
         std::max(criterion.miss_vertical_m, criterion.settled_vertical_m) >
             criterion.clearance_vertical_m + given_m;
}

/// The nose can stop before the opening within 1 / `reserve` of the distance left. Assumes the speed that the
/// vehicle has, plus what it gains from the last command within its response time.
bool canStop(const RelativeState& relative, const TargetEstimate& target, const MissionState& mission,
             const NavigatorParams& params, double reserve = 1.0) {
  const double told_mps = uprightRotation(target).col(0).dot(mission.told_odom_mps);
  const double now_mps = std::max(0.0, relative.velocity_window_mps.x());
  const double gained_mps = params.vehicle.braking_mps2 * params.vehicle.response_sec;
  const double speed_mps = std::max(now_mps, std::min(told_mps, now_mps + gained_mps));
  const double stop_m = stoppingDistance(speed_mps, params.vehicle);
  return relative.distance() - params.vehicle.half_length_m > reserve * stop_m;
}

/// The wind's component along the window's normal [m/s].
double windAlong(const TargetEstimate& target, const MissionState& mission) {
  return uprightRotation(target).col(0).dot(mission.wind_odom_mps);
}

/// The window is seen at its committed place. After a loss, odometry may have come back elsewhere.
bool seesCommitted(const Situation& situation, const TargetEstimate& committed) {
  if (!situation.target || !situation.target->sign_trusted) return false;
  const Eigen::Vector3d moved =
      situation.target->T_odom_window.translation() - committed.T_odom_window.translation();
  return moved.norm() < kMaxUpdateJumpM + reachM(committed.motion);
}

}  // namespace

Decision Commit::step(const Situation& situation, MissionState& mission) {
  refine(situation, mission);
  const TargetEstimate target = ahead(*mission.committed, situation.now_sec);
  const RelativeState relative = relate(*situation.vehicle, target);
  const double blind_sec = std::max(0.0, situation.now_sec - target.stamp_sec);
  const double unknown_sec = std::max(0.0, situation.now_sec - mission.committed_sec);
  const CommitCriterion criterion = criterionWith(target, *situation.vehicle, mission, *params_, unknown_sec);
  if (relative.distance() > 0.0) mission.blind_sec = std::max(mission.blind_sec, blind_sec);

  Decision decision;
  decision.wish.velocity_odom_mps =
      velocityAlongAxis(relative, target, againstTailwind(forwardSpeed(relative), target, mission),
                        mission.wind_odom_mps, *params_);
  decision.wish.yaw_rate_radps = yawRateFor(relative.heading_error_rad, mission, *params_);
  decision.reason = formatted("through the opening, window seen %.2f s ago", blind_sec);
  if (is_through_) {
    const double room_m = params_->commit.exit_distance_m + relative.distance();
    decision.wish.velocity_odom_mps =
        velocityAlongAxis(relative, target, speedToExit(room_m, relative) - windAlong(target, mission),
                          mission.wind_odom_mps, *params_);
    decision.reason = formatted("%.2f m behind the window", -relative.distance());
    const bool stands = situation.vehicle->velocity_odom_mps.norm() < kStoppedMps;
    if (stands && room_m < kLeftOfExit * params_->commit.exit_distance_m) decision.event = Event::kCrossed;
  } else if (canStop(relative, target, mission, *params_, is_bound_ ? kReserve : 1.0)) {
    is_bound_ = false;
    mission.predicted_miss_m = criterion.missM();
    turnBackIfUnsafe(criterion, blind_sec, decision);
  } else {
    is_bound_ = true;
  }
  return decision;
}

void Commit::turnBackIfUnsafe(const CommitCriterion& criterion, double blind_sec, Decision& decision) const {
  if (isBroken(criterion, *params_)) {
    decision.event = Event::kCriterionUnmet;
    decision.reason = "turning back: " + criterion.unmet;
  } else if (disagreements_ >= kInARow) {
    decision.event = Event::kCriterionUnmet;
    decision.reason =
        formatted("turning back: the window is seen %.2f m away from where it was", disagreement_m_);
  } else if (forbidden_ >= kInARow) {
    decision.event = Event::kCriterionUnmet;
    decision.reason = "turning back: " + why_forbidden_;
  } else if (blind_sec > params_->commit.max_blind_sec) {
    decision.event = Event::kCriterionUnmet;
    decision.reason = formatted("turning back: window not seen for %.2f s", blind_sec);
  }
}

void Commit::refine(const Situation& situation, MissionState& mission) {
  if (!entry_odom_m_) entry_odom_m_ = mission.committed->T_odom_window.translation();
  if (situation.target && situation.target_is_new) heedForbidden(*situation.target);
  if (!situation.target || !situation.target->sign_trusted) return;
  const Eigen::Vector3d moved = situation.target->T_odom_window.translation() - *entry_odom_m_;
  disagreement_m_ = moved.norm();
  if (disagreement_m_ < kMaxUpdateJumpM + reachM(situation.target->motion)) {
    mission.committed = situation.target;
    mission.committed_sec = situation.now_sec;
    disagreements_ = 0;
  } else if (situation.target_is_new && ++disagreements_ >= kInARow && is_bound_) {
    entry_odom_m_ = situation.target->T_odom_window.translation();
  }
}

void Commit::heedForbidden(const TargetEstimate& target) {
  const std::string why = target.approach_forbidden.empty() ? whyClosed(target) : target.approach_forbidden;
  forbidden_ = why.empty() ? 0 : forbidden_ + 1;
  if (!why.empty()) why_forbidden_ = why;
}

// Constant speed regardless of the offset: acceleration spent forward would be missing for steering.
double Commit::forwardSpeed(const RelativeState& relative) {
  const double room_m = params_->commit.exit_distance_m + relative.distance();
  if (room_m < 0.1) is_through_ = true;
  const double stop_mps = stoppingSpeed(room_m, params_->vehicle);
  return std::min(std::max(stop_mps, 0.1), params_->commit.speed_mps);
}

// Also flies back to the exit point after an overshoot or after being blown out.
double Commit::speedToExit(double room_m, const RelativeState& relative) const {
  const double coasted_m = relative.velocity_window_mps.x() * params_->vehicle.response_sec;
  const double wish_mps = params_->align.lateral_gain_hz * (room_m - coasted_m);
  return std::clamp(wish_mps, -params_->hold.speed_mps, params_->hold.speed_mps);
}

bool Commit::canResume(const Situation& situation, const MissionState& mission,
                       const NavigatorParams& params) {
  if (!mission.committed || !situation.vehicle) return false;
  const double unknown_sec = std::max(0.0, situation.now_sec - mission.committed_sec);
  const TargetEstimate committed = ahead(*mission.committed, situation.now_sec);
  const RelativeState relative = relate(*situation.vehicle, committed);
  if (relative.distance() < -params.vehicle.half_length_m) return true;
  if (canStop(relative, committed, mission, params) && !seesCommitted(situation, committed)) return false;
  return !isBroken(criterionWith(committed, *situation.vehicle, mission, params, unknown_sec), params);
}

}  // namespace window_ingress::navigation
