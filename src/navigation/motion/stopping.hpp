/// Stopping distance of a vehicle that answers after `VehicleParams::response_sec` and then brakes.
#pragma once

#include <cmath>

#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// Fastest speed from which the vehicle still stops within `distance_m` [m/s]; 0 for distances that are not
/// positive. The inverse of `stoppingDistance`.
inline double stoppingSpeed(double distance_m, const VehicleParams& vehicle) {
  if (!(distance_m > 0.0)) return 0.0;
  const double response_sec = vehicle.response_sec;
  return vehicle.braking_mps2 *
         (std::sqrt(response_sec * response_sec + 2.0 * distance_m / vehicle.braking_mps2) - response_sec);
}

/// v * response + v^2 / (2 * braking) [m].
inline double stoppingDistance(double speed_mps, const VehicleParams& vehicle) {
  return std::abs(speed_mps) * vehicle.response_sec + speed_mps * speed_mps / (2.0 * vehicle.braking_mps2);
}

}  // namespace window_ingress::navigation
