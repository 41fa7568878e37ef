/// Stopping distance of a vehicle that answers after `VehicleParams::response_sec` and then brakes.
#pragma once

#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// Fastest speed from which the vehicle still stops within `distance_m` [m/s]; 0 for distances that are not
/// positive. The inverse of `stoppingDistance`.
double stoppingSpeed(double distance_m, const VehicleParams& vehicle);

/// v * response + v^2 / (2 * braking) [m].
double stoppingDistance(double speed_mps, const VehicleParams& vehicle);

}  // namespace window_ingress::navigation
