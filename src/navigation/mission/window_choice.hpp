/// Which known window the mission flies at, and when it leaves one.
#pragma once

#include <string>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// The target is at the place of a window that was left for good.
bool wasLeftForGood(const TargetEstimate& target, const MissionState& mission);

/// Why the mission must leave the target: it turned out to be another window or closed. Empty if it need not.
std::string whyOtherWindow(const TargetEstimate& target);

/// Leaves such a target and remembers its place.
void leaveOtherWindow(const Situation& situation, MissionState& mission);

/// The target was left for good, or lies in the direction of a window that is known to be another one. Only
/// the direction counts, because the distance was computed with a size that window does not have.
bool isKnownOther(const TargetEstimate& target, const VehicleState& vehicle, const MissionState& mission);

/// Why the mission leaves the window flown at: the operator or the facade has chosen another target. Empty if
/// there is no reason, and always in COMMIT.
std::string whySentElsewhere(const Situation& situation, State state, const MissionState& mission);

/// If all tries at a window have failed and `search/next_window` is set: gives up this window and searches
/// for the next instead of ending the mission. \param decision of BACK_OFF itself; a time-out ends the
/// mission
void turnToNextWindow(State state, const NavigatorParams& params, MissionState& mission, Decision& decision);

}  // namespace window_ingress::navigation
