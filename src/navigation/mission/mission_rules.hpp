/// Rules of the whole mission, independent of the state.
#pragma once

#include <string>
#include <vector>

#include "navigation/mission/flown_window.hpp"
#include "navigation/mission/mission_clock.hpp"
#include "navigation/mission/mission_state.hpp"
#include "navigation/motion/disturbance_observer.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// Checks the parameters; `input.max_future_sec` is taken from the vehicle. \throws std::invalid_argument
/// that lists every fault
NavigatorParams checked(NavigatorParams params);

/// All reasons against a start; empty if there are none. \param flown_at the last window flown at: in its
/// opening, the turn of a search would hit the border
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged, const FlownWindow& flown_at,
                                      const NavigatorParams& params);

/// Timeout of the mission or of this state, as text; empty if none. HOLD has its own (`hold/timeout_sec`).
std::string whatTimedOut(State state, const MissionClock& clock, const TimeoutParams& timeouts);

/// The first missing input of this state; empty if none is missing.
std::string missingInput(State state, const Situation& situation);

/// How the vehicle moves beside its commands; empty if it follows them.
std::string howItMovesBeside(const DisturbanceObserver& observer, const InputParams& params);

/// Why a state other than COMMIT must not fly at this target: seen from behind, or not the window flown at
/// before. Empty if there is no reason.
std::string whyNotFlownAt(const TargetEstimate& target, const VehicleState& vehicle, State state,
                          const MissionState& mission);

}  // namespace window_ingress::navigation
