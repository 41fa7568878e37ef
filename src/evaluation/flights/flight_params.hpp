#pragma once

#include <set>
#include <string>

#include "evaluation/flights/flight_perception.hpp"
#include "evaluation/flights/projected_detector.hpp"
#include "simulation/world.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::evaluation {

/// Everything that flies.
struct FlightParams : PerceptionParams {
  navigation::NavigatorParams navigator;
  double step_rate_hz = 30.0;   ///< of the navigator [1/s]
  bool without_images = false;  ///< the window is seen by `ProjectedDetector`, no image is drawn
  SightParams sight;
  std::set<std::string>
      said;  ///< by the operator: "vehicle/half_width_m"; what is not is taken from the world
};

/// What a user's file says to the nodes, for a flight. \throws InputError
FlightParams readFlightParams(const std::string& file);

/// The parameters with what is known of the vehicle and its target before the flight.
FlightParams withFactsOf(const simulation::World& world, FlightParams params);

}  // namespace window_ingress::evaluation
