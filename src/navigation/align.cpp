#include "window_ingress/navigation/align.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::navigation {
namespace {
constexpr double kNearAxisM = 0.3;
}

double HeightProbe::climb(double height_m) {
  constexpr double kReachedM = 0.05;
  const auto& align = params_.align;
  if (!start_m_) start_m_ = height_m;
  const double side = count_ % 2 == 0 ? 1.0 : -1.0;
  const double turning_m = std::clamp(*start_m_ + side * align.probe_amplitude_m, params_.limits.min_height_m,
                                      params_.limits.max_height_m);
  if (std::abs((returns_ ? *start_m_ : turning_m) - height_m) < kReachedM) {
    if (returns_) ++count_;
    returns_ = !returns_;
  }
  const double goal_m = returns_ ? *start_m_ : turning_m;
  return std::copysign(std::min(align.probe_speed_mps, 0.1 + std::abs(goal_m - height_m)), goal_m - height_m);
}

Eigen::Vector3d StepPacer::pace(const Eigen::Vector3d& velocity_mps, const Situation& situation) {
  if (!params_.stepped) return velocity_mps;
  if (situation.now_sec < pause_until_sec_) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d position = situation.vehicle->T_odom_base.translation();
  if (!from_odom_m_) from_odom_m_ = position;
  if ((position - *from_odom_m_).norm() < params_.step_m) return velocity_mps;
  from_odom_m_.reset();
  pause_until_sec_ = situation.now_sec + params_.step_pause_sec;
  return Eigen::Vector3d::Zero();
}

void Align::enter(double now_sec) {
  *this = Align(params_);
  ambiguous_since_sec_ = now_sec;
}

Decision Align::step(const Situation& situation) {
  const RelativeState relative = relate(*situation.vehicle, *situation.target);
  if (!situation.target->sign_trusted) return resolveSign(situation, relative);
  ambiguous_since_sec_ = situation.now_sec;
  if (situation.target->approach_forbidden.empty()) probe_.reset();
  return moveOntoAxis(situation, relative);
}

Decision Align::resolveSign(const Situation& situation, const RelativeState& relative) {
  in_funnel_since_sec_.reset();
  Decision decision;
  decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, params_);
  const double height_m = situation.vehicle->T_odom_base.translation().z();
  if (situation.now_sec - ambiguous_since_sec_ < params_.align.settle_sec) {
    const double limit_mps = params_.align.vertical_speed_mps;
    decision.wish.velocity_odom_mps.z() = climbFor(-relative.vertical(), limit_mps, params_);
    decision.reason = "sign of the window's yaw not certain: looking";
    return decision;
  }
  decision.wish.velocity_odom_mps.z() = probe_.climb(height_m);
  decision.reason =
      "sign of the window's yaw not certain: height probe " + std::to_string(probe_.count() + 1);
  if (probe_.isExhausted()) {
    decision.event = Event::kGiveUp;
    decision.reason =
        "sign of the window's yaw not certain after " + std::to_string(probe_.count()) + " height probes";
  }
  return decision;
}

Decision Align::moveOntoAxis(const Situation& situation, const RelativeState& relative) {
  const auto& target = *situation.target;
  const Contract contract = evaluateContract(relative, target.opening, pitchOf(*situation.vehicle), params_);
  Decision decision;
  const bool has_size = target.fit != pose::Fit::kUnknown;
  if (has_size && std::min(contract.clearance_lateral_m, contract.clearance_vertical_m) <= 0.0) {
    decision.event = Event::kGiveUp;
    decision.reason = "the opening is too small for the vehicle";
    return decision;
  }
  const double retreat_mps =
      -climbFor(params_.align.min_distance_m - relative.distance(), params_.align.lateral_speed_mps, params_);
  decision.wish.velocity_odom_mps = pacer_.pace(
      velocityAlongAxis(relative, target, std::min(0.0, retreat_mps), Eigen::Vector3d::Zero(), params_),
      situation);
  decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, params_);
  decision.reason = "moving onto the window's normal";
  const bool is_forbidden = !target.approach_forbidden.empty();
  const bool near_axis =
      contract.openness >= 0.15 || (is_forbidden && std::abs(relative.lateral()) < kNearAxisM);
  if (!near_axis) {
    in_funnel_since_sec_.reset();
  } else if (!in_funnel_since_sec_) {
    in_funnel_since_sec_ = situation.now_sec;
  }
  if (!in_funnel_since_sec_ || situation.now_sec - *in_funnel_since_sec_ < params_.align.dwell_sec)
    return decision;
  if (is_forbidden) return probeForLeave(situation, decision);
  decision.event = Event::kAligned;
  return decision;
}

// Motion may yet show the size of the opening, or that the frames are as they are said to be.
Decision Align::probeForLeave(const Situation& situation, Decision decision) {
  decision.wish.velocity_odom_mps.z() = probe_.climb(situation.vehicle->T_odom_base.translation().z());
  decision.reason = "approach forbidden: " + situation.target->approach_forbidden;
  if (probe_.isExhausted()) decision.event = Event::kGiveUp;
  return decision;
}

}  // namespace window_ingress::navigation
