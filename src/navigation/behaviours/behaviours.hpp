#pragma once

#include <memory>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// The behaviour of a state that begins; null for one that has none. \param from was left for it
std::unique_ptr<Behaviour> behaviourOf(State state, State from, double now_sec, bool may_climb,
                                       const NavigatorParams& params);

}  // namespace window_ingress::navigation
