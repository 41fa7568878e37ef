#pragma once

#include <string>

#include "simulation/scenario/quadrotor_params.hpp"
#include "simulation/scenario/sensor_params.hpp"

namespace window_ingress::simulation {

/// Makes vehicle and odometry respond as with a real autopilot: sets the known values of the profile and
/// leaves the others.
///
/// `arducopter_4_0`, `arducopter_4_3`: ArduCopter 4.0.7 and 4.3.2 in software-in-the-loop behind MAVROS.
/// `arducopter_4_0_default`: ArduCopter 4.0.7 with its default acceleration and its gyro's drift.
/// `px4_1_13_gps`: PX4 1.13 with GPS. `crisp`: a simulator's controller (so3) that responds in a fifth of a
/// second. `slow`: the default vehicle with at most 0.6 m/s^2. `default`, `external` and unknown profiles
/// change only the name. Comparison with measurements: test `vehicle_profiles_test.cpp` and doc/scenarios.md.
void applyProfile(const std::string& profile, QuadrotorParams& vehicle, OdometryParams& odometry);

}  // namespace window_ingress::simulation
