#pragma once

#include "window_ingress/evaluation/closed_loop_flight.hpp"
#include "window_ingress/simulation/world.hpp"

namespace window_ingress::evaluation {

/// The parameters with what is known of the vehicle and its target before the flight.
FlightParams withFactsOf(const simulation::World& world, FlightParams params);

}  // namespace window_ingress::evaluation
