/// Position hold: with zero velocity alone, a vehicle drifts in wind.
#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

constexpr double kSettleSec = 0.8;  ///< a vehicle that still moves keeps its present place after this time

/// Remembers the place to keep: where the vehicle first stands, or where it is after `kSettleSec` if it does
/// not. Forgets it once `is_kept` is false, when odometry jumps, or beyond `hold/leash_m`. Uses odometry
/// only, no window estimate.
void rememberPlace(bool is_kept, const Situation& situation, const HoldParams& params, MissionState& mission);

/// Velocity back to the kept place, in odom axes; zero without one.
Eigen::Vector3d velocityToPlace(const VehicleState& vehicle, const MissionState& mission,
                                const NavigatorParams& params);

/// The part of this velocity that leads back to the kept place and, in front of the window, not towards it.
Eigen::Vector3d onlyToPlace(const Eigen::Vector3d& velocity_odom_mps, const VehicleState& vehicle,
                            const MissionState& mission, const HoldParams& params);

}  // namespace window_ingress::navigation
