#include "navigation/motion/stopping.hpp"

#include <cmath>

namespace window_ingress::navigation {

double stoppingSpeed(double distance_m, const VehicleParams& vehicle) {
  if (!(distance_m > 0.0)) return 0.0;
  const double response_sec = vehicle.response_sec;
  return vehicle.braking_mps2 *
         (std::sqrt(response_sec * response_sec + 2.0 * distance_m / vehicle.braking_mps2) - response_sec);
}

double stoppingDistance(double speed_mps, const VehicleParams& vehicle) {
  return std::abs(speed_mps) * vehicle.response_sec + speed_mps * speed_mps / (2.0 * vehicle.braking_mps2);
}

}  // namespace window_ingress::navigation
