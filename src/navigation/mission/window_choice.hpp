/// Which of the windows known is flown at, and which no longer.
#pragma once

#include <string>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// At the place of a window that was left for good.
bool wasLeftForGood(const TargetEstimate& target, const MissionState& memory);

/// The target is another window now than the one flown at: the operator, or the memory of all windows, has
/// chosen it. COMMIT flies on. \return why the window before is left; empty if it is not
std::string whySentElsewhere(const Situation& situation, State state, const MissionState& memory);

/// Where the mission would end because a window was tried in vain, and `search/next_window` allows another
/// one: gives up the window instead, and searches on.
void turnToNextWindow(State state, const NavigatorParams& params, MissionState& memory, Decision& decision);

}  // namespace window_ingress::navigation
