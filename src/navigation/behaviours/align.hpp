#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "navigation/behaviours/step_pacer.hpp"
#include "navigation/mission/window_choice.hpp"
#include "navigation/motion/axis_guidance.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {

/// Excitation that needs no sign: straight up by a fixed amplitude and back, then down and back, alternately.
///
/// While both planar hypotheses are alive, a sideways step based on the pose is a coin flip. A change of
/// height is the same for both hypotheses and cannot lead to the wrong side. It also takes the camera off the
/// window's height, where both hypotheses are equally upright. Seen from above or below, upright borders lean
/// differently for the two.
class HeightProbe {
 public:
  explicit HeightProbe(const NavigatorParams& params) : params_(&params) {}
  explicit HeightProbe(NavigatorParams&&) = delete;  ///< the parameters must outlive this

  void reset() { *this = HeightProbe(*params_); }
  bool isExhausted() const { return count_ >= params_->align.max_probes; }
  int count() const { return count_; }

  /// Sets the height at which the probe starts and ends, unless it is set. By default the first `climb` sets
  /// it.
  void beginAt(double height_m) {
    if (!has_begun_) start_m_ = height_m;
    has_begun_ = true;
  }

  /// Vertical velocity of the probe at this height, up positive [m/s].
  double climb(double height_m) {
    constexpr double kReachedM = 0.05, kProbeMps = 0.4;
    const double amplitude_m = params_->align.probe_amplitude_m;
    beginAt(height_m);
    const double side = count_ % 2 == 0 ? 1.0 : -1.0;
    const auto turningAt = [&](double offset_m) {
      return std::clamp(start_m_ + offset_m, params_->limits.min_height_m, params_->limits.max_height_m);
    };
    double turning_m = turningAt(side * amplitude_m);
    if (std::abs(turning_m - start_m_) < 0.5 * amplitude_m)  // at a limit of the height
      turning_m = turningAt(-side * amplitude_m);
    if (std::abs((returns_ ? start_m_ : turning_m) - height_m) < kReachedM) {
      if (returns_) ++count_;
      returns_ = !returns_;
    }
    const double goal_m = returns_ ? start_m_ : turning_m;
    return std::copysign(std::min(kProbeMps, 0.1 + std::abs(goal_m - height_m)), goal_m - height_m);
  }

 private:
  const NavigatorParams* params_;
  double start_m_ = 0.0;
  bool has_begun_ = false;
  bool returns_ = false;
  int count_ = 0;
};

/// ALIGN (P15): yaw keeps the window in view and height follows its centre. Once the normal is trusted, the
/// vehicle moves sideways onto it. The vehicle never moves towards the window; with an untrusted normal it
/// only changes height.
class Align : public Behaviour {
 public:
  Align(const NavigatorParams& params, double now_sec) : Behaviour(params), ambiguous_since_sec_(now_sec) {}

  Decision step(const Situation& situation, MissionState& mission) override {
    if (const std::string why = whyOtherWindow(*situation.target); !why.empty())
      return {{}, true, Event::kOtherWindow, why};
    const RelativeState relative = relate(*situation.vehicle, *situation.target);
    Decision decision;
    decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, situation, *params_);
    if (!situation.target->sign_trusted) return resolveSign(situation, relative, decision);
    ambiguous_since_sec_ = situation.now_sec;
    if (situation.target->approach_forbidden.empty()) probe_.reset();
    return moveOntoAxis(situation, mission, relative, decision);
  }

 private:
  static constexpr double kNearAxisM = 0.3;
  static constexpr double kFunnelDwellSec = 0.2;   ///< time in the funnel before ALIGN ends
  static constexpr double kAmbiguousSec = 1.2;     ///< unknown yaw sign for this time starts a height probe
  static constexpr double kWellInFunnel = 0.9475;  ///< fraction of the funnel's half width

  Decision resolveSign(const Situation& situation, const RelativeState& relative, Decision decision) {
    in_funnel_since_sec_.reset();
    decision.keeps_place = true;
    double& climb_mps = decision.wish.velocity_odom_mps.z();
    if (situation.now_sec - ambiguous_since_sec_ < kAmbiguousSec) {
      climb_mps = velocityTowards(-relative.vertical(), params_->align.vertical_speed_mps, *params_);
      decision.reason = "sign of the window's yaw unknown: looking";
      return decision;
    }
    climb_mps = probe_.climb(situation.vehicle->T_odom_base.translation().z());
    decision.reason = "sign of the window's yaw unknown: height probe " + std::to_string(probe_.count() + 1);
    if (probe_.isExhausted()) {
      decision.event = Event::kGiveUp;
      decision.reason = formatted("sign of the window's yaw unknown after %d height probes", probe_.count());
    }
    return decision;
  }

  bool isNearAxis(const RelativeState& relative, const CommitCriterion& criterion, bool is_forbidden) const {
    if (is_forbidden && std::abs(relative.lateral()) < kNearAxisM) return true;
    if (!pacer_.isStepped()) return criterion.fullness <= kWellInFunnel;
    return std::max(std::abs(relative.lateral()), std::abs(relative.vertical())) < kNearAxisM;
  }

  Decision moveOntoAxis(const Situation& situation, const MissionState& mission,
                        const RelativeState& relative, Decision decision) {
    const auto& target = *situation.target;
    const CommitCriterion criterion = criterionWith(target, situation, mission, *params_);
    if (target.fit != estimation::Fit::kUnknown && !criterion.hasClearance())
      return {{}, false, Event::kGiveUp, "the opening is too small for the vehicle"};
    const bool is_forbidden = !target.approach_forbidden.empty();
    const bool near_axis = isNearAxis(relative, criterion, is_forbidden);
    const double retreat_mps = -velocityTowards(params_->align.min_distance_m - relative.distance(),
                                                params_->align.lateral_speed_mps, *params_);
    const double forward_mps = near_axis && !is_forbidden ? 0.0 : std::min(0.0, retreat_mps);
    decision.wish.velocity_odom_mps =
        pacer_.pace(velocityAlongAxis(relative, target, forward_mps, situation.wind_odom_mps, *params_),
                    uprightRotation(target), situation);
    decision.reason = "moving onto the window's normal";
    if (heldSec(near_axis, situation.now_sec, in_funnel_since_sec_) < kFunnelDwellSec) return decision;
    if (!is_forbidden) {
      decision.event = Event::kAligned;
      return decision;
    }
    // Vertical motion may still reveal the opening's size, or confirm the configured frames.
    const double height_m = situation.vehicle->T_odom_base.translation().z();
    probe_.beginAt(height_m - relative.vertical());
    decision.wish.velocity_odom_mps.z() = probe_.climb(height_m);
    decision.reason = "approach forbidden: " + target.approach_forbidden;
    if (probe_.isExhausted()) decision.event = Event::kGiveUp;
    return decision;
  }

  HeightProbe probe_{*params_};
  StepPacer pacer_{*params_};
  double ambiguous_since_sec_;
  std::optional<double> in_funnel_since_sec_;
};

}  // namespace window_ingress::navigation
