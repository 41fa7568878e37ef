#include "window_ingress/navigation/hold.hpp"

#include "window_ingress/navigation/commit.hpp"

namespace window_ingress::navigation {

void Hold::enter(State from, double now_sec) {
  *this = Hold(params_);
  from_ = from;
  since_sec_ = now_sec;
}

Decision Hold::step(const Situation& situation, const MissionMemory& memory) {
  const double held_sec = situation.now_sec - since_sec_;
  const bool is_good = situation.vehicle && situation.image_fault.empty();
  if (!is_good) good_since_sec_.reset();
  if (is_good && !good_since_sec_) good_since_sec_ = situation.now_sec;
  Decision decision;
  decision.keeps_place = true;
  decision.reason = !situation.vehicle ? situation.vehicle_fault
                    : !is_good         ? situation.image_fault
                                       : situation.target_fault;
  if (decision.reason.empty()) decision.reason = "inputs are back";
  if (is_good && situation.now_sec - *good_since_sec_ >= params_.hold.dwell_sec) {
    decision.event = wayOn(situation, memory, held_sec, decision.reason);
  }
  if (!decision.event && held_sec > params_.hold.timeout_sec) {
    decision.event = Event::kGiveUp;
    decision.reason = "held too long: " + decision.reason;
  }
  return decision;
}

std::optional<Event> Hold::wayOn(const Situation& situation, const MissionMemory& memory, double held_sec,
                                 std::string& reason) const {
  if (from_ == State::kCommit) {
    if (Commit::canResume(situation, memory, params_)) return Event::kResumed;
    reason = "the commit cannot be resumed";
    if (memory.trusted) return Event::kWindowLost;
    if (!memory.was_in_front) return Event::kGiveUp;  // where the opening is now is not known
    return situation.target ? std::optional(Event::kReacquired) : std::nullopt;
  }
  if (situation.target) {
    reason = "window seen again";
    return Event::kReacquired;
  }
  if (from_ == State::kSearch || from_ == State::kBackOff) {
    return memory.trusted && from_ == State::kBackOff ? Event::kWindowLost : Event::kInputFresh;
  }
  if (held_sec < params_.hold.patience_sec) return std::nullopt;
  return memory.trusted ? Event::kWindowLost : Event::kInputFresh;
}

}  // namespace window_ingress::navigation
