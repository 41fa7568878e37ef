#pragma once

#include <string>

#include "window_ingress/simulation/sensor_params.hpp"
#include "window_ingress/simulation/vehicle_params.hpp"

namespace window_ingress::simulation {

/// Makes vehicle and odometry answer as a real autopilot does. Profiles: see doc/scenarios.md. An unknown one
/// changes nothing but the name.
void applyProfile(const std::string& profile, VehicleParams& vehicle, OdometryParams& odometry);

}  // namespace window_ingress::simulation
