#pragma once

#include <string>

#include "simulation/scenario/quadrotor_params.hpp"
#include "simulation/scenario/sensor_params.hpp"

namespace window_ingress::simulation {

/// Makes vehicle and odometry answer as a real autopilot does: sets what is known of the profile, leaves the
/// rest.
///
/// `arducopter_4_0`, `arducopter_4_3`: ArduCopter 4.0.7 and 4.3.2 in software-in-the-loop behind MAVROS;
/// `arducopter_4_0_default`: the former with its acceleration and its gyro's drift as shipped.
/// `px4_1_13_gps`: PX4 1.13 by satellites. `crisp`: a simulator's controller (so3) that answers in a fifth of
/// a second. `slow`: the default vehicle, at most 0.6 m/s^2. `default`, `external` and unknown ones change
/// nothing but the name. What each reproduces of what was measured: test `vehicle_profiles_test.cpp` and
/// doc/scenarios.md.
void applyProfile(const std::string& profile, QuadrotorParams& vehicle, OdometryParams& odometry);

}  // namespace window_ingress::simulation
