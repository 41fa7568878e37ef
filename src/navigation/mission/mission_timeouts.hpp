#pragma once

#include <string>

#include "navigation/mission/mission_clock.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

inline double timeoutOf(State state, const TimeoutParams& timeouts) {
  switch (state) {
    case State::kSearch:
      return timeouts.search_sec;
    case State::kAlign:
      return timeouts.align_sec;
    case State::kApproach:
      return timeouts.approach_sec;
    case State::kCommit:
      return timeouts.commit_sec;
    case State::kBackOff:
      return timeouts.back_off_sec;
    default:
      return timeouts.total_sec;
  }
}

/// What has lasted too long, for people: the mission as a whole, or its stay in this state; empty if neither.
inline std::string whatTimedOut(State state, const MissionClock& clock, const TimeoutParams& timeouts) {
  if (clock.inMissionSec() > timeouts.total_sec)
    return std::string("mission timed out in ") + toString(state);
  if (clock.inStateSec() > timeoutOf(state, timeouts)) return std::string(toString(state)) + " timed out";
  return "";
}

}  // namespace window_ingress::navigation
