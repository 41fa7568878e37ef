/// Staying where the vehicle is: zero velocity alone drifts away in wind.
#pragma once

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

constexpr double kSettleSec =
    0.8;  ///< a vehicle that does not stand keeps the place where it is after this time

/// The place is where the vehicle first stands, or where it is when it still does not after a while; it is
/// forgotten as soon as nobody wants it kept, and with the odometry it was known in. By odometry alone: no
/// estimate of any window takes part.
void rememberPlace(bool is_kept, const Situation& situation, const HoldParams& params, MissionState& memory);

/// Velocity back to the place, in odom axes; zero without a place.
Eigen::Vector3d velocityToPlace(const VehicleState& vehicle, const MissionState& memory,
                                const NavigatorParams& params);

/// Of this velocity what leads back to the place and, while in front of it, not towards the window.
Eigen::Vector3d onlyToPlace(const Eigen::Vector3d& velocity_odom_mps, const VehicleState& vehicle,
                            const MissionState& memory, const HoldParams& params);

}  // namespace window_ingress::navigation
