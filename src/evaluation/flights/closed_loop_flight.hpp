#pragma once

#include <cstdint>
#include <vector>

#include "evaluation/flights/flight_observer.hpp"
#include "evaluation/flights/flight_params.hpp"
#include "evaluation/flights/flight_summary.hpp"
#include "evaluation/flights/flight_timing.hpp"

namespace window_ingress::evaluation {

/// One flight in one process, by the objects that the nodes use: the world's images through detector, pose
/// and filter to the navigator, and its setpoints back. Deterministic: scenario, seed and parameters give the
/// same result to the bit. The opening's size, the vehicle's body and its camera are known facts and taken
/// from the world, unless the operator says otherwise. \param timing the flight's is added to it \throws
/// InputError, std::invalid_argument (parameters), std::runtime_error (no renderer). Without
/// images, observers are not shown any.
FlightResult flyOnce(const simulation::Scenario& scenario, std::uint32_t seed, const FlightParams& params,
                     const std::vector<FlightObserver*>& observers = {}, FlightTiming* timing = nullptr);

}  // namespace window_ingress::evaluation
