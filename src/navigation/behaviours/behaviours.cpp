#include "navigation/behaviours/behaviours.hpp"

namespace window_ingress::navigation {

void Behaviours::enter(State state, State from, double now_sec) {
  was_near_ = was_near_ || state == State::kApproach;
  if (state == State::kSearch) search_.enter(!was_near_);
  if (state == State::kAlign) align_.enter(now_sec);
  if (state == State::kApproach) approach_.enter();
  if (state == State::kCommit) commit_.enter();
  if (state == State::kBackOff) back_off_.enter();
  if (state == State::kHold) hold_.enter(from);
}

std::optional<Decision> Behaviours::step(State state, const Situation& situation, MissionState& memory) {
  switch (state) {
    case State::kSearch:
      return search_.step(situation, memory);
    case State::kAlign:
      return align_.step(situation, memory);
    case State::kApproach:
      return approach_.step(situation, memory);
    case State::kCommit:
      return commit_.step(situation, memory);
    case State::kBackOff:
      return back_off_.step(situation, memory);
    case State::kHold:
      return hold_.step(situation, memory);
    case State::kIdle:
    case State::kPassed:
    case State::kAborted:
      break;
  }
  return std::nullopt;
}

}  // namespace window_ingress::navigation
