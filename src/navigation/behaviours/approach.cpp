#include <algorithm>
#include <cmath>

#include "navigation/behaviours/behaviours.hpp"
#include "navigation/mission/opening_policy.hpp"
#include "navigation/motion/stopping.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kLooksWithinM = 0.4;
constexpr double kWallOfFunnel = 0.35;  // outer part of the funnel's half width: here the speed falls to zero
constexpr double kLeaveFactor = 1.3,
                 kLeaveSec = 0.5;  // outside kLeaveFactor funnels for this many seconds: align again

}  // namespace

Decision Approach::step(const Situation& situation, MissionState& mission) {
  if (auto other = leaveOtherWindow(situation, mission)) return *other;
  const auto& target = *situation.target;
  const RelativeState relative = relate(*situation.vehicle, target);
  Decision decision;
  decision.wish.yaw_rate_radps = yawRateFor(headingErrorTowards(relative, *params_), mission, *params_);
  if (!target.sign_trusted || !target.approach_forbidden.empty()) {
    decision.event = Event::kMisaligned;
    decision.reason = target.sign_trusted ? "approach forbidden: " + target.approach_forbidden
                                          : "sign of the window's yaw unknown again";
    return decision;
  }
  const CommitCriterion criterion = criterionWith(target, *situation.vehicle, mission, *params_);
  RelativeState to_goal = relative;
  to_goal.position_window_m.y() -= asideM(criterion, situation);
  decision.wish.velocity_odom_mps = pacer_.pace(
      velocityAlongAxis(to_goal, target, againstTailwind(forwardSpeed(criterion, relative), target, mission),
                        mission.wind_odom_mps, *params_),
      uprightRotation(target), situation);
  decision.reason = criterion.holds ? "on the window's normal" : criterion.unmet;
  if (!criterion.holds) mission.unmet = criterion.unmet;
  decision.event = judge(criterion, relative, situation, decision.reason);
  const bool is_to_be_asked = isToBeAsked(target, mission, params_->commit);
  mission.opening_asked = looks_ && is_to_be_asked;
  const bool only_that = criterion.unmet == whyNotEntered(target, mission, params_->commit);
  if (is_to_be_asked && !looks_ && only_that && !decision.event)
    decision.reason = "on the window's normal; will ask at the commit line whether it is open";
  if (decision.event == Event::kCommitReached) {
    mission.committed = target;
    mission.committed_sec = situation.now_sec;
    mission.predicted_miss_m = criterion.missM();
    mission.blind_sec = 0.0;
  }
  return decision;
}

double Approach::forwardSpeed(const CommitCriterion& criterion, const RelativeState& relative) const {
  const double in_view = std::clamp(1.5 - std::abs(relative.bearing_rad) / 0.3, 0.0, 1.0);
  const double in_funnel = std::clamp((1.0 - criterion.fullness) / kWallOfFunnel, 0.0, 1.0);
  const double speed_mps = params_->approach.speed_mps * in_funnel * in_view;
  const double end_m = criterion.holds ? params_->vehicle.half_length_m : criterion.commit_distance_m;
  const double room_m = relative.distance() - end_m;
  if (room_m < 0.0) return velocityTowards(room_m, params_->back_off.speed_mps, *params_);
  return std::min(speed_mps, stoppingSpeed(room_m, params_->vehicle));
}

double Approach::asideM(const CommitCriterion& criterion, const Situation& situation) const {
  const bool knows = !criterion.opening_unverified || isSeenOpen(*situation.target);
  if (!looks_ || !waiting_since_sec_ || knows) return 0.0;
  return lookAside(situation.now_sec - *waiting_since_sec_, criterion, params_->commit);
}

double Approach::patienceSec(const TargetEstimate& target) const {
  return looks_ ? waitAtLineSec(target, params_->commit) : params_->approach.patience_sec;
}

std::optional<Event> Approach::judge(const CommitCriterion& criterion, const RelativeState& relative,
                                     const Situation& situation, std::string& reason) {
  const bool at_line = relative.distance() <= criterion.commit_distance_m + 0.05;
  if (at_line && criterion.holds) return Event::kCommitReached;
  const double outside_sec =
      heldSec(criterion.fullness > kLeaveFactor, situation.now_sec, outside_since_sec_);
  // Beside the axis the commit line is further away from the window.
  const bool waits =
      at_line || (looks_ && relative.distance() <= criterion.commit_distance_m + kLooksWithinM);
  const double waiting_sec = heldSec(waits, situation.now_sec, waiting_since_sec_);
  looks_ = waits && (looks_ || criterion.opening_unverified);
  if (waiting_sec > patienceSec(*situation.target)) return Event::kCriterionUnmet;
  if (outside_sec > kLeaveSec) {
    reason = "out of the funnel: " + criterion.unmet;
    return at_line ? Event::kCriterionUnmet : Event::kMisaligned;
  }
  return std::nullopt;
}

}  // namespace window_ingress::navigation
