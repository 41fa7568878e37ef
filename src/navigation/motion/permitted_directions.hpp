#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// What of this velocity the state may command in this situation; the rest is cut away. It knows nothing of
/// guidance: whatever a behaviour wishes by mistake, this holds.
///
/// - no odometry, or a state that does not move: nothing
/// - SEARCH: upward and downward, and back to the place that is kept
/// - ALIGN, APPROACH: normal not trusted: as SEARCH; outside the funnel: nothing towards the window, and near
///   the wall only away from it; behind the window: as SEARCH
/// - APPROACH: towards the window only with a fresh, trusted estimate that does not forbid it, and within the
///   funnel
/// - COMMIT: only with a committed window
/// - BACK_OFF: only with a trusted normal in memory, nothing towards the window, within the reveal only away
/// - HOLD, PASSED: back to the place that is kept
/// - nowhere beyond the height limits and the fence, with room to stop
/// Back to a place means: never towards a window in front.
Eigen::Vector3d permittedVelocity(const Eigen::Vector3d& velocity_odom_mps, State state,
                                  const Situation& situation, const MissionState& memory,
                                  const NavigatorParams& params);

}  // namespace window_ingress::navigation
