#pragma once

#include <optional>
#include <string>
#include <vector>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// What speaks against a start, all of it; empty if nothing does. \param flown_at window of the mission
/// before: the vehicle may still be in its opening, where a search would turn it against the border
std::vector<std::string> unmetToStart(const Situation& situation, bool engaged,
                                      const std::optional<TargetEstimate>& flown_at,
                                      const NavigatorParams& params);

/// Whether the vehicle is near the wall of that window, or behind it: what is above may be eaves or a
/// ceiling.
bool isUnderRoof(const VehicleState& vehicle, const TargetEstimate& flown_at);

}  // namespace window_ingress::navigation
