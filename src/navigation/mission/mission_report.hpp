#pragma once

#include "navigation/behaviours/behaviour.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::navigation {

NavigatorReport reportOn(const Situation& situation, const MissionState& memory,
                         const NavigatorParams& params);

}  // namespace window_ingress::navigation
