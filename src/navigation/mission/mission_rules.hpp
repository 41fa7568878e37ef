/// Rules of a mission under way, independent of the state.
#pragma once

#include <string>

#include "navigation/mission/mission_clock.hpp"
#include "navigation/mission/mission_state.hpp"
#include "navigation/motion/disturbance_observer.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// Timeout of the mission or of this state, as text; empty if none. HOLD has its own (`hold/timeout_sec`).
/// The operator's answer may take `commit/ask_sec` more.
std::string whatTimedOut(State state, const MissionClock& clock, const MissionState& mission,
                         const NavigatorParams& params);

/// The first missing input of this state; empty if none is missing.
std::string missingInput(State state, const Situation& situation);

/// How the vehicle moves beside its commands; empty if it follows them.
std::string howItMovesBeside(const DisturbanceObserver& observer, const InputParams& params);

/// Why a state other than COMMIT must not fly at this target: seen from behind, or not the window flown at
/// before. Empty if there is no reason.
std::string whyNotFlownAt(const TargetEstimate& target, const VehicleState& vehicle, State state,
                          const MissionState& mission);

}  // namespace window_ingress::navigation
