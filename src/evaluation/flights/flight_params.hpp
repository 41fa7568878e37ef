#pragma once

#include "evaluation/flights/projected_detector.hpp"
#include "simulation/world.hpp"
#include "window_ingress/configuration/overlay.hpp"

namespace window_ingress::evaluation {

/// Everything that flies: what a user's file says to the nodes; what it does not say of vehicle and opening
/// is taken from the world.
struct FlightParams : configuration::Overlay {
  bool without_images = false;  ///< the window is seen by `ProjectedDetector`, no image is drawn
  SightParams sight = {};
};

/// The parameters with what is known of the vehicle and its target before the flight.
FlightParams withFactsOf(const simulation::World& world, FlightParams params);

}  // namespace window_ingress::evaluation
