#pragma once

#include "evaluation/flights/closed_loop_flight.hpp"
#include "simulation/world.hpp"

namespace window_ingress::evaluation {

/// The parameters with what is known of the vehicle and its target before the flight.
FlightParams withFactsOf(const simulation::World& world, FlightParams params);

}  // namespace window_ingress::evaluation
