#pragma once

#include <string>
#include <vector>

#include "navigation/mission/flown_window.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// What speaks against a start, all of it; empty if nothing does. \param flown_at in its opening a search
/// would turn the vehicle against the border
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged, const FlownWindow& flown_at,
                                      const NavigatorParams& params);

}  // namespace window_ingress::navigation
