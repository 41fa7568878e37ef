#pragma once

#include "navigation/mission/mission_state.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/transition_table.hpp"

namespace window_ingress::navigation {

/// The part of this velocity that the state may command in this situation. Independent of guidance: a
/// mistaken velocity of a behaviour is cut here.
///
/// - no odometry, or a state that does not move: nothing
/// - SEARCH: vertical, and back to the kept place
/// - ALIGN, APPROACH: with an untrusted normal or behind the window as SEARCH; outside the funnel nothing
///   towards the window, and near the wall only away from it
/// - APPROACH: towards the window only within the funnel and with a fresh, trusted estimate that does not
///   forbid it
/// - COMMIT: anything, but only with a committed window
/// - BACK_OFF: only with a trusted normal in memory; nothing towards the window; within the reveal only away
/// - HOLD, PASSED: back to the kept place
/// - all states: height limits and fence, with room to stop
/// - "back to the kept place" never leads towards a window in front
Eigen::Vector3d permittedVelocity(const Eigen::Vector3d& velocity_odom_mps, State state,
                                  const Situation& situation, const MissionState& mission,
                                  const NavigatorParams& params);

/// The fence leaves next to nothing of this velocity.
bool isHeldByFence(const Eigen::Vector3d& velocity_odom_mps, const Situation& situation,
                   const MissionState& mission, const NavigatorParams& params);

}  // namespace window_ingress::navigation
