#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "navigation/behaviours/step_pacer.hpp"
#include "navigation/mission/opening_policy.hpp"
#include "navigation/mission/window_choice.hpp"
#include "navigation/motion/axis_guidance.hpp"

namespace window_ingress::navigation {

/// APPROACH (P16): forward along the normal, with corrections sideways and in height. The forward speed falls
/// to zero at the funnel's wall. While the criterion does not hold, the vehicle can stop at the commit line.
class Approach : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& mission) override {
    if (const std::string why = whyOtherWindow(*situation.target); !why.empty())
      return {{}, true, Event::kOtherWindow, why};
    const auto& target = *situation.target;
    const RelativeState relative = relate(*situation.vehicle, target);
    // Towards the window's centre; near the wall along its normal, because a turned body is wider.
    const bool is_near = relative.distance() < params_->limits.wall_distance_m;
    Decision decision;
    decision.wish.yaw_rate_radps =
        yawRateFor(is_near ? relative.heading_error_rad : relative.bearing_rad, situation, *params_);
    if (!target.sign_trusted || !target.approach_forbidden.empty()) {
      decision.event = Event::kMisaligned;
      decision.reason = target.sign_trusted ? "approach forbidden: " + target.approach_forbidden
                                            : "sign of the window's yaw unknown again";
      return decision;
    }
    const CommitCriterion criterion = criterionWith(target, situation, mission, *params_);
    RelativeState to_goal = relative;
    to_goal.position_window_m.y() -= asideM(criterion, situation);
    const double forward_mps = againstTailwind(forwardSpeed(criterion, relative), target, situation);
    decision.wish.velocity_odom_mps =
        pacer_.pace(velocityAlongAxis(to_goal, target, forward_mps, situation.wind_odom_mps, *params_),
                    uprightRotation(target), situation);
    decision.reason = criterion.holds ? "on the window's normal" : criterion.unmet;
    if (!criterion.holds) mission.unmet = criterion.unmet;
    decision.event = judge(criterion, relative, situation, decision.reason);
    const bool is_to_be_asked = isToBeAsked(target, mission, params_->commit);
    mission.opening_asked = is_to_be_asked && (looks_ || mission.opening_asked);
    const bool only_that = criterion.unmet == whyNotEntered(target, mission, params_->commit);
    if (is_to_be_asked && !mission.opening_asked && only_that && !decision.event)
      decision.reason = "on the window's normal; will ask at the commit line whether it is open";
    if (decision.event == Event::kCommitReached) {
      mission.committed = target;
      mission.committed_sec = situation.now_sec;
      mission.predicted_miss_m = criterion.miss_m.maxCoeff();
      mission.blind_sec = 0.0;
    }
    return decision;
  }

 private:
  static constexpr double kLooksWithinM = 0.4;
  static constexpr double kWallOfFunnel =
      0.35;                                    ///< outer part of its half width: the speed falls to zero here
  static constexpr double kLeaveFactor = 1.3;  ///< this many funnels from the axis ..
  static constexpr double kLeaveSec = 0.5;     ///< .. for so long: align again

  double forwardSpeed(const CommitCriterion& criterion, const RelativeState& relative) const {
    const double in_view = std::clamp(1.5 - std::abs(relative.bearing_rad) / 0.3, 0.0, 1.0);
    const double in_funnel = std::clamp((1.0 - criterion.fullness) / kWallOfFunnel, 0.0, 1.0);
    const double speed_mps = params_->approach.speed_mps * in_funnel * in_view;
    const double end_m = criterion.holds ? params_->vehicle.half_length_m : criterion.commit_distance_m;
    const double room_m = relative.distance() - end_m;
    if (room_m < 0.0) return velocityTowards(room_m, params_->back_off.speed_mps, *params_);
    return std::min(speed_mps, stoppingSpeed(room_m, params_->vehicle));
  }

  /// Lateral offset from the axis, to see whether the window is open [m].
  double asideM(const CommitCriterion& criterion, const Situation& situation) const {
    const bool knows = !criterion.opening_unverified || isSeenOpen(*situation.target);
    if (!looks_ || !waiting_since_sec_ || knows) return 0.0;
    return lookAside(situation.now_sec - *waiting_since_sec_, criterion, params_->commit);
  }

  std::optional<Event> judge(const CommitCriterion& criterion, const RelativeState& relative,
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
    const double patience_sec =
        looks_ ? waitAtLineSec(*situation.target, params_->commit) : params_->approach.patience_sec;
    if (waiting_sec > patience_sec) return Event::kCriterionUnmet;
    if (outside_sec > kLeaveSec) {
      reason = "out of the funnel: " + criterion.unmet;
      return at_line ? Event::kCriterionUnmet : Event::kMisaligned;
    }
    return std::nullopt;
  }

  StepPacer pacer_{*params_};
  std::optional<double> outside_since_sec_;
  std::optional<double> waiting_since_sec_;
  bool looks_ = false;  ///< waits at the line to see whether the window is open
};

}  // namespace window_ingress::navigation
