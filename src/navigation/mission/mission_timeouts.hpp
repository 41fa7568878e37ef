#pragma once

#include <string>

#include "navigation/mission/mission_clock.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// What has lasted too long, for people: the mission as a whole, or its stay in this state; empty if neither.
std::string whatTimedOut(State state, const MissionClock& clock, const TimeoutParams& timeouts);

}  // namespace window_ingress::navigation
