#include <algorithm>
#include <cmath>

#include "navigation/behaviours/behaviours.hpp"
#include "navigation/mission/mission_rules.hpp"

namespace window_ingress::navigation {

Decision BackOff::step(const Situation& situation, MissionState& mission) {
  if (!mission.trusted) return withoutNormal(mission);
  const auto& target = *mission.trusted;
  const RelativeState relative = relate(*situation.vehicle, target);
  const double room_m = params_->back_off.distance_m - relative.distance();
  const double speed_mps = std::min(params_->back_off.speed_mps, 0.1 + std::max(0.0, room_m));
  Decision decision;
  const double turning_radius_m = std::hypot(params_->vehicle.half_length_m, params_->vehicle.half_width_m);
  const bool is_clear = relative.distance() > turning_radius_m + params_->vehicle.margin_m;
  decision.wish.velocity_odom_mps = velocityAlongAxis(
      relative, target, againstTailwind(-speed_mps, target, mission), mission.wind_odom_mps, *params_);
  if (is_clear) decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, mission, *params_);
  decision.reason = "away from the window along its normal";
  if (room_m <= 0.0) {
    decision.wish.velocity_odom_mps.setZero();
    decision.keeps_place = true;
    decision.event = judge(situation, mission, relative, decision.reason);
  }
  return decision;
}

Decision BackOff::withoutNormal(const MissionState& mission) const {
  const Event event = hasRetriesLeft(mission, params_->back_off) ? Event::kBackedOff : Event::kGiveUp;
  return {{}, true, event, "no trusted normal to back off along"};
}

std::optional<Event> BackOff::judge(const Situation& situation, const MissionState& mission,
                                    const RelativeState& relative, std::string& reason) {
  if (!hasRetriesLeft(mission, params_->back_off)) {
    reason = "given up after " + std::to_string(params_->back_off.max_retries) + " retries";
    if (!mission.unmet.empty()) reason += ": " + mission.unmet;
    return Event::kGiveUp;
  }
  if (situation.target) {
    if (situation.target_is_new) ++frames_;
    if (frames_ < kFoundImages) return std::nullopt;
    reason = "window seen again";
    return Event::kReacquired;
  }
  frames_ = 0;
  constexpr double kFacingRad = 0.1;
  if (std::abs(relative.bearing_rad) > kFacingRad) return std::nullopt;
  reason = "window still not in view";
  return Event::kBackedOff;
}

}  // namespace window_ingress::navigation
