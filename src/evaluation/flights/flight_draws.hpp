#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "simulation/scenario/scenario.hpp"

namespace window_ingress::evaluation {

/// Flights to be flown of one scenario: by seed, where within its range each named key lies.
using FlightDraws = std::map<std::uint32_t, simulation::Quantiles>;

/// A csv file with a header `seed,KEY,...` (paths of keys with a range, as in `simulation::Quantiles`) and a
/// row a flight. \throws TableError that names file and line
FlightDraws readDraws(const std::string& file);

}  // namespace window_ingress::evaluation
