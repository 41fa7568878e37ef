#pragma once

#include <string>
#include <vector>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// What speaks against a start, all of it; empty if nothing does.
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged,
                                      const NavigatorParams& params);

}  // namespace window_ingress::navigation
