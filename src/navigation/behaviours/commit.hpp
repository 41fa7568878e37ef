#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "navigation/behaviours/behaviour.hpp"
#include "navigation/mission/opening_policy.hpp"
#include "navigation/motion/axis_guidance.hpp"
#include "navigation/motion/moving_target.hpp"
#include "navigation/motion/stopping.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {

/// COMMIT: flies through the opening along its normal, by `MissionState::committed`, which is frozen in odom.
/// Sightings that agree with it refine it. Several in a row that disagree or forbid the approach turn the
/// vehicle back. Past the point of no return disagreeing sightings replace it, because then odometry is
/// wrong. COMMIT ends standing still behind the window. The vehicle turns back only while the nose can stop
/// in front of the plane. After the point of no return this needs twice the stopping distance: a vehicle that
/// has slowed halfway would drift where it can neither pass nor turn.
class Commit : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& mission) override {
    refine(situation, mission);
    const TargetEstimate target = ahead(*mission.committed, situation.now_sec);
    const RelativeState relative = relate(*situation.vehicle, target);
    const double blind_sec = std::max(0.0, situation.now_sec - target.stamp_sec);
    const CommitCriterion criterion = criterionNow(target, situation, mission, *params_);
    if (relative.distance() > 0.0) mission.blind_sec = std::max(mission.blind_sec, blind_sec);
    const double room_m = params_->commit.exit_distance_m + relative.distance();
    is_through_ = is_through_ || room_m < kReachedM;

    Decision decision;
    const double forward_mps =
        is_through_ ? speedToExit(room_m, relative) - normalOf(target).dot(situation.wind_odom_mps)
                    : againstTailwind(forwardSpeed(room_m), target, situation);
    decision.wish.velocity_odom_mps =
        velocityAlongAxis(relative, target, forward_mps, situation.wind_odom_mps, *params_);
    decision.wish.yaw_rate_radps = yawRateFor(relative.heading_error_rad, situation, *params_);
    decision.reason = formatted("through the opening, window seen %.2f s ago", blind_sec);
    if (is_through_) {
      decision.reason = formatted("%.2f m behind the window", -relative.distance());
      const bool stands = situation.vehicle->velocity_odom_mps.norm() < kStoppedMps;
      if (stands && room_m < kLeftOfExit * params_->commit.exit_distance_m) decision.event = Event::kCrossed;
      return decision;
    }
    is_bound_ = !canStop(relative, target, situation, *params_, is_bound_ ? kReserve : 1.0);
    if (is_bound_) return decision;
    mission.predicted_miss_m = criterion.miss_m.maxCoeff();
    const std::string why_back = whyTurnBack(criterion, blind_sec);
    if (why_back.empty()) return decision;
    decision.event = Event::kCriterionUnmet;
    decision.reason = "turning back: " + why_back;
    return decision;
  }

  /// Whether COMMIT may resume after a loss of odometry: the vehicle is already through, or the window was
  /// seen lately and the criterion still holds for the committed window with the drift since. A vehicle that
  /// can still stop must also see the window at its place.
  static bool canResume(const Situation& situation, const MissionState& mission,
                        const NavigatorParams& params) {
    if (!mission.committed || !situation.vehicle) return false;
    const TargetEstimate committed = ahead(*mission.committed, situation.now_sec);
    const RelativeState relative = relate(*situation.vehicle, committed);
    if (relative.distance() < -params.vehicle.half_length_m) return true;
    if (situation.now_sec - committed.stamp_sec > params.commit.max_blind_sec) return false;
    if (canStop(relative, committed, situation, params) && !seesAtItsPlace(situation, committed))
      return false;
    return !isBroken(criterionNow(committed, situation, mission, params), params);
  }

 private:
  static constexpr int kInARow = 3;  ///< consecutive sightings that agree are believed
  static constexpr double kMaxUpdateJumpM =
      0.15;  ///< updates further from the place at the commit are ignored
  static constexpr double kStoppedMps = 0.15;
  static constexpr double kReachedM = 0.1;  ///< before the exit distance
  static constexpr double kReserve = 2.0;   ///< stopping distances needed to turn back after the point of no
                                            ///< return
  static constexpr double kLeftOfExit =
      0.4;  ///< of the exit distance: standing this near to its end is enough

  /// The criterion with the drift since the window's place was last confirmed.
  static CommitCriterion criterionNow(const TargetEstimate& committed, const Situation& situation,
                                      const MissionState& mission, const NavigatorParams& params) {
    const double unknown_sec = std::max(0.0, situation.now_sec - mission.committed_sec);
    return criterionWith(committed, situation, mission, params, unknown_sec);
  }

  /// The predicted miss, or the systematic offset at the plane, exceeds the clearance by half of the
  /// vehicle's margin. A smaller excess is no reason to turn back.
  static bool isBroken(const CommitCriterion& criterion, const NavigatorParams& params) {
    const double given_m = params.vehicle.margin_m / 2.0;
    return (criterion.miss_m.cwiseMax(criterion.settled_m).array() > criterion.clearance_m.array() + given_m)
        .any();
  }

  /// The nose can stop before the opening within 1 / `reserve` of the distance left. Assumes the speed that
  /// the vehicle has, plus what it gains from the last command within its response time.
  static bool canStop(const RelativeState& relative, const TargetEstimate& target, const Situation& situation,
                      const NavigatorParams& params, double reserve = 1.0) {
    const double told_mps = normalOf(target).dot(situation.told_odom_mps);
    const double now_mps = std::max(0.0, relative.velocity_window_mps.x());
    const double gained_mps = params.vehicle.braking_mps2 * params.vehicle.response_sec;
    const double speed_mps = std::max(now_mps, std::min(told_mps, now_mps + gained_mps));
    const double stop_m = stoppingDistance(speed_mps, params.vehicle);
    return relative.distance() - params.vehicle.half_length_m > reserve * stop_m;
  }

  /// The window is seen at its committed place. After a loss, odometry may have come back elsewhere.
  static bool seesAtItsPlace(const Situation& situation, const TargetEstimate& committed) {
    return situation.target && situation.target->sign_trusted &&
           distanceBetween(*situation.target, committed) < kMaxUpdateJumpM + reachM(committed.motion);
  }

  std::string whyTurnBack(const CommitCriterion& criterion, double blind_sec) const {
    if (isBroken(criterion, *params_))
      return criterion.unmet.empty() ? "predicted miss above the clearance" : criterion.unmet;
    if (disagreements_ >= kInARow)
      return formatted("the window is seen %.2f m away from where it was", disagreement_m_);
    if (forbidden_ >= kInARow) return why_forbidden_;
    if (blind_sec > params_->commit.max_blind_sec) return formatted("window not seen for %.2f s", blind_sec);
    return "";
  }

  void refine(const Situation& situation, MissionState& mission) {
    if (!entry_odom_m_) entry_odom_m_ = mission.committed->T_odom_window.translation();
    if (!situation.target) return;
    const TargetEstimate& seen = *situation.target;
    if (situation.target_is_new) {
      const std::string why = seen.approach_forbidden.empty() ? whyClosed(seen) : seen.approach_forbidden;
      forbidden_ = why.empty() ? 0 : forbidden_ + 1;
      if (!why.empty()) why_forbidden_ = why;
    }
    if (!seen.sign_trusted) return;
    disagreement_m_ = (seen.T_odom_window.translation() - *entry_odom_m_).norm();
    if (disagreement_m_ < kMaxUpdateJumpM + reachM(seen.motion)) {
      mission.committed = seen;
      mission.committed_sec = situation.now_sec;
      disagreements_ = 0;
    } else if (situation.target_is_new && ++disagreements_ >= kInARow && is_bound_) {
      entry_odom_m_ = seen.T_odom_window.translation();
    }
  }

  // Constant speed regardless of the offset: acceleration spent forward would be missing for steering.
  double forwardSpeed(double room_m) const {
    return std::min(std::max(stoppingSpeed(room_m, params_->vehicle), 0.1), params_->commit.speed_mps);
  }

  // Also flies back to the exit point after an overshoot or after being blown out.
  double speedToExit(double room_m, const RelativeState& relative) const {
    const double coasted_m = relative.velocity_window_mps.x() * params_->vehicle.response_sec;
    const double wish_mps = params_->align.lateral_gain_hz * (room_m - coasted_m);
    return std::clamp(wish_mps, -params_->hold.speed_mps, params_->hold.speed_mps);
  }

  std::optional<Eigen::Vector3d> entry_odom_m_;  ///< window's place at the commit: limits the sum of updates
  int disagreements_ = 0;                        ///< new sightings in a row that disagree with the place
  double disagreement_m_ = 0.0;                  ///< of the last sighting
  int forbidden_ = 0;                            ///< new sightings in a row that forbid the approach
  std::string why_forbidden_;
  bool is_bound_ = false;    ///< past the point of no return
  bool is_through_ = false;  ///< has reached the exit distance
};

}  // namespace window_ingress::navigation
