/// What the mission as a whole demands, apart from what any single state does.
#pragma once

#include <string>
#include <vector>

#include "navigation/behaviours/behaviour.hpp"
#include "navigation/mission/flown_window.hpp"
#include "navigation/mission/mission_clock.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// The parameters as given. \throws std::invalid_argument that lists every fault
NavigatorParams checked(NavigatorParams params);

/// What speaks against a start, all of it; empty if nothing does. \param flown_at in its opening a search
/// would turn the vehicle against the border
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged, const FlownWindow& flown_at,
                                      const NavigatorParams& params);

/// What has lasted too long, for people: the mission as a whole, or its stay in this state; empty if neither.
/// How long HOLD lasts is its own matter (`hold/timeout_sec`).
std::string whatTimedOut(State state, const MissionClock& clock, const TimeoutParams& timeouts);

/// What this state needs and does not have; empty if it has all.
std::string missingInput(State state, const Situation& situation);

/// Why a state other than COMMIT must not fly at this target: seen from behind, or another window than the
/// one flown at before; empty if nothing speaks against it.
std::string whyNotFlownAt(const TargetEstimate& target, const VehicleState& vehicle, State state,
                          const MissionState& memory);

/// Whether the mission looks for the window again after having backed off, or is given up.
bool hasRetriesLeft(const MissionState& memory, const BackOffParams& params);

/// For people: the vehicle goes beside what it is told.
std::string goesAstray(double turned_rad);

}  // namespace window_ingress::navigation
