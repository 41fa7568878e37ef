#pragma once

#include <optional>
#include <string>

#include "navigation/behaviours/commit.hpp"

namespace window_ingress::navigation {

/// HOLD: zero velocity. If only images are missing, the vehicle backs off after a while. Once the inputs have
/// been good for a while, the mission continues with the commit, the window, its remembered place or a new
/// search. HOLD gives up after a timeout.
class Hold : public Behaviour {
 public:
  /// \param from the state before HOLD
  Hold(const NavigatorParams& params, State from) : Behaviour(params), from_(from) {}

  Decision step(const Situation& situation, MissionState& mission) override {
    held_sec_ += situation.dt_sec;
    const bool needs_image = from_ != State::kCommit;  // COMMIT flies on without images
    const bool is_good = situation.vehicle && situation.setpoint_fault.empty() &&
                         (situation.image_fault.empty() || !needs_image);
    good_sec_ = is_good ? good_sec_ + situation.dt_sec : 0.0;
    Decision decision;
    decision.keeps_place = true;
    decision.reason = !situation.vehicle                  ? situation.vehicle_fault
                      : !situation.setpoint_fault.empty() ? situation.setpoint_fault
                      : !is_good                          ? situation.image_fault
                                                          : situation.target_fault;
    if (decision.reason.empty()) decision.reason = "inputs are back";
    if (is_good && good_sec_ >= kGoodInputSec) decision.event = wayOn(situation, mission, decision.reason);
    if (!decision.event && situation.setpoint_fault.empty() && !situation.target &&
        mayRetreat(situation, mission))
      decision.event = Event::kWindowLost;
    if (!decision.event && held_sec_ > params_->hold.timeout_sec) {
      decision.event = Event::kGiveUp;
      decision.reason = "held too long: " + decision.reason;
    }
    return decision;
  }

 private:
  /// Inputs must be good for this time before the mission continues.
  static constexpr double kGoodInputSec = 0.2;

  // Without images the mission cannot continue, but odometry and the normal still lead away from the wall.
  // The vehicle retreats at once where wind could carry it into the wall meanwhile.
  bool mayRetreat(const Situation& situation, const MissionState& mission) const {
    if (from_ == State::kSearch || !situation.vehicle || !mission.trusted) return false;
    const double distance_m = relate(*situation.vehicle, *mission.trusted).distance();
    if (distance_m < -params_->vehicle.half_length_m) return false;  // no way back through the opening
    const bool is_near = from_ != State::kCommit && distance_m < params_->limits.wall_distance_m;
    return is_near || held_sec_ > params_->hold.patience_sec;
  }

  std::optional<Event> wayOn(const Situation& situation, const MissionState& mission,
                             std::string& reason) const {
    if (!mission.trusted && !mission.was_in_front) {
      reason = "the vehicle is in an opening whose place is unknown";
      return Event::kGiveUp;
    }
    if (from_ == State::kCommit) {
      if (Commit::canResume(situation, mission, *params_)) return Event::kResumed;
      reason = "the commit cannot be resumed";
      if (mission.trusted) return Event::kWindowLost;
      return situation.target ? std::optional(Event::kReacquired) : std::nullopt;
    }
    if (situation.target) {
      reason = "window seen again";
      return Event::kReacquired;
    }
    if (from_ == State::kSearch) return Event::kInputFresh;
    if (from_ != State::kBackOff && held_sec_ < params_->hold.patience_sec) return std::nullopt;
    return mission.trusted ? Event::kWindowLost : Event::kInputFresh;
  }

  State from_;
  double held_sec_ = 0.0;
  double good_sec_ = 0.0;
};

}  // namespace window_ingress::navigation
