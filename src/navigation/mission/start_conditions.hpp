/// What must hold before a mission starts.
#pragma once

#include <string>
#include <vector>

#include "navigation/mission/flown_window.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// Checks the parameters; `input.max_future_sec` is taken from the vehicle. \throws std::invalid_argument
/// that lists every fault
NavigatorParams checked(NavigatorParams params);

/// All reasons against a start; empty if there are none. \param flown_at the last window flown at: in its
/// opening, the turn of a search would hit the border
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged, const FlownWindow& flown_at,
                                      const NavigatorParams& params);

}  // namespace window_ingress::navigation
