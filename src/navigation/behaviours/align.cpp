#include <algorithm>
#include <cmath>

#include "navigation/behaviours/behaviours.hpp"
#include "navigation/motion/stopping.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {
constexpr double kNearAxisM = 0.3;
constexpr double kFunnelDwellSec = 0.2;  // time in the funnel before ALIGN ends
constexpr double kAmbiguousSec = 1.2;    // unknown yaw sign for this time starts a height probe
constexpr double kProbeMps = 0.4;
constexpr double kWellInFunnel = 0.9475;  // fraction of the funnel's half width
}  // namespace

void HeightProbe::beginAt(double height_m) {
  if (!start_m_) start_m_ = height_m;
}

double HeightProbe::climb(double height_m) {
  constexpr double kReachedM = 0.05;
  const auto& align = params_->align;
  beginAt(height_m);
  const double side = count_ % 2 == 0 ? 1.0 : -1.0;
  const auto turningAt = [&](double offset_m) {
    return std::clamp(*start_m_ + offset_m, params_->limits.min_height_m, params_->limits.max_height_m);
  };
  double turning_m = turningAt(side * align.probe_amplitude_m);
  if (std::abs(turning_m - *start_m_) < 0.5 * align.probe_amplitude_m)  // at a limit of the height
    turning_m = turningAt(-side * align.probe_amplitude_m);
  if (std::abs((returns_ ? *start_m_ : turning_m) - height_m) < kReachedM) {
    if (returns_) ++count_;
    returns_ = !returns_;
  }
  const double goal_m = returns_ ? *start_m_ : turning_m;
  return std::copysign(std::min(kProbeMps, 0.1 + std::abs(goal_m - height_m)), goal_m - height_m);
}

Eigen::Vector3d StepPacer::pace(const Eigen::Vector3d& velocity_odom_mps,
                                const Eigen::Matrix3d& R_odom_window, const Situation& situation) {
  constexpr double kStandingMps = 0.1, kThereM = 0.02;
  if (!isStepped()) return velocity_odom_mps;
  const Eigen::Vector3d position = situation.vehicle->T_odom_base.translation();
  const double left_m = from_odom_m_ ? params_->align.step_m - (position - *from_odom_m_).norm() : 0.0;
  if (left_m > kThereM) return along(velocity_odom_mps, left_m);
  from_odom_m_.reset();
  const bool stands = situation.vehicle->velocity_odom_mps.norm() < kStandingMps;
  const double looked_sec = heldSec(stands, situation.now_sec, standing_since_sec_);
  if (!(looked_sec >= params_->align.step_pause_sec)) return Eigen::Vector3d::Zero();
  standing_since_sec_.reset();
  Eigen::Index axis;
  (R_odom_window.transpose() * velocity_odom_mps).cwiseAbs().maxCoeff(&axis);
  along_ = R_odom_window.col(axis);
  from_odom_m_ = position;
  return along(velocity_odom_mps, params_->align.step_m);
}

Eigen::Vector3d StepPacer::along(const Eigen::Vector3d& velocity_odom_mps, double left_m) const {
  const double most_mps = stoppingSpeed(left_m, params_->vehicle);
  return std::clamp(velocity_odom_mps.dot(along_), -most_mps, most_mps) * along_;
}

Decision Align::step(const Situation& situation, MissionState& mission) {
  if (auto other = leaveOtherWindow(situation, mission)) return *other;
  const RelativeState relative = relate(*situation.vehicle, *situation.target);
  if (!situation.target->sign_trusted) return resolveSign(situation, mission, relative);
  ambiguous_since_sec_ = situation.now_sec;
  if (situation.target->approach_forbidden.empty()) probe_.reset();
  return moveOntoAxis(situation, mission, relative);
}

Decision Align::resolveSign(const Situation& situation, const MissionState& mission,
                            const RelativeState& relative) {
  in_funnel_since_sec_.reset();
  Decision decision;
  decision.keeps_place = true;
  decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, mission, *params_);
  const double height_m = situation.vehicle->T_odom_base.translation().z();
  if (situation.now_sec - ambiguous_since_sec_ < kAmbiguousSec) {
    const double limit_mps = params_->align.vertical_speed_mps;
    decision.wish.velocity_odom_mps.z() = velocityTowards(-relative.vertical(), limit_mps, *params_);
    decision.reason = "sign of the window's yaw unknown: looking";
    return decision;
  }
  decision.wish.velocity_odom_mps.z() = probe_.climb(height_m);
  decision.reason = "sign of the window's yaw unknown: height probe " + std::to_string(probe_.count() + 1);
  if (probe_.isExhausted()) {
    decision.event = Event::kGiveUp;
    decision.reason = formatted("sign of the window's yaw unknown after %d height probes", probe_.count());
  }
  return decision;
}

bool Align::isNearAxis(const RelativeState& relative, const CommitCriterion& criterion,
                       bool is_forbidden) const {
  if (is_forbidden && std::abs(relative.lateral()) < kNearAxisM) return true;
  if (!pacer_.isStepped()) return criterion.fullness <= kWellInFunnel;
  return std::max(std::abs(relative.lateral()), std::abs(relative.vertical())) < kNearAxisM;
}

Decision Align::moveOntoAxis(const Situation& situation, MissionState& mission,
                             const RelativeState& relative) {
  const auto& target = *situation.target;
  const CommitCriterion criterion = criterionWith(target, *situation.vehicle, mission, *params_);
  const bool has_size = target.fit != estimation::Fit::kUnknown;
  if (has_size && std::min(criterion.clearance_lateral_m, criterion.clearance_vertical_m) <= 0.0)
    return {{}, false, Event::kGiveUp, "the opening is too small for the vehicle"};
  Decision decision;
  const bool is_forbidden = !target.approach_forbidden.empty();
  const bool near_axis = isNearAxis(relative, criterion, is_forbidden);
  const double retreat_mps = -velocityTowards(params_->align.min_distance_m - relative.distance(),
                                              params_->align.lateral_speed_mps, *params_);
  const double forward_mps = near_axis && !is_forbidden ? 0.0 : std::min(0.0, retreat_mps);
  decision.wish.velocity_odom_mps =
      pacer_.pace(velocityAlongAxis(relative, target, forward_mps, mission.wind_odom_mps, *params_),
                  uprightRotation(target), situation);
  decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, mission, *params_);
  decision.reason = "moving onto the window's normal";
  if (heldSec(near_axis, situation.now_sec, in_funnel_since_sec_) < kFunnelDwellSec) return decision;
  if (is_forbidden) return probeForLeave(situation, relative, decision);
  decision.event = Event::kAligned;
  return decision;
}

// Vertical motion may still reveal the opening's size, or confirm the configured frames.
Decision Align::probeForLeave(const Situation& situation, const RelativeState& relative, Decision decision) {
  const double height_m = situation.vehicle->T_odom_base.translation().z();
  probe_.beginAt(height_m - relative.vertical());
  decision.wish.velocity_odom_mps.z() = probe_.climb(height_m);
  decision.reason = "approach forbidden: " + situation.target->approach_forbidden;
  if (probe_.isExhausted()) decision.event = Event::kGiveUp;
  return decision;
}

}  // namespace window_ingress::navigation
