#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "navigation/behaviours/behaviour.hpp"
#include "navigation/motion/axis_guidance.hpp"

namespace window_ingress::navigation {

/// BACK_OFF (P17): flies away from the window along its last trusted normal in odom, until the window can be
/// seen again. Within the reveal the vehicle neither turns nor moves sideways. Clear of the reveal it returns
/// to the normal and turns the camera towards the window.
class BackOff : public Behaviour {
 public:
  using Behaviour::Behaviour;

  Decision step(const Situation& situation, MissionState& mission) override {
    if (!mission.trusted) {
      const Event event = hasRetriesLeft(mission) ? Event::kBackedOff : Event::kGiveUp;
      return {{}, true, event, "no trusted normal to back off along"};
    }
    const auto& target = *mission.trusted;
    const RelativeState relative = relate(*situation.vehicle, target);
    const double room_m = params_->back_off.distance_m - relative.distance();
    const double speed_mps = std::min(params_->back_off.speed_mps, 0.1 + std::max(0.0, room_m));
    Decision decision;
    const double turning_radius_m = std::hypot(params_->vehicle.half_length_m, params_->vehicle.half_width_m);
    const bool is_clear = relative.distance() > turning_radius_m + params_->vehicle.margin_m;
    if (is_clear) decision.wish.yaw_rate_radps = yawRateFor(relative.bearing_rad, situation, *params_);
    decision.reason = "away from the window along its normal";
    if (room_m <= 0.0) {
      decision.keeps_place = true;
      decision.event = judge(situation, mission, relative, decision.reason);
    } else {
      decision.wish.velocity_odom_mps =
          velocityAlongAxis(relative, target, againstTailwind(-speed_mps, target, situation),
                            situation.wind_odom_mps, *params_);
    }
    return decision;
  }

 private:
  static constexpr double kFacingRad = 0.1;

  bool hasRetriesLeft(const MissionState& mission) const {
    return mission.back_offs <= params_->back_off.max_retries;
  }

  std::optional<Event> judge(const Situation& situation, const MissionState& mission,
                             const RelativeState& relative, std::string& reason) {
    if (!hasRetriesLeft(mission)) {
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
    if (std::abs(relative.bearing_rad) > kFacingRad) return std::nullopt;
    reason = "window still not in view";
    return Event::kBackedOff;
  }

  int frames_ = 0;
};

}  // namespace window_ingress::navigation
