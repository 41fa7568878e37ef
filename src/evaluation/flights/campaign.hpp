#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/flights/flight_results.hpp"

namespace window_ingress::evaluation {

/// "A..B" (both included) or "A"; nothing if it is neither, or more than a million seeds.
std::optional<std::vector<std::uint32_t>> parseSeeds(const std::string& text);

/// Every N-th element, beginning with the I-th, of "I/N" with I from 1 to N; nothing if it is no such text.
std::optional<std::vector<std::uint32_t>> shardOf(const std::vector<std::uint32_t>& seeds,
                                                  const std::string& text);

/// The other way round: "1..20, 25".
std::string seedsText(const std::vector<std::uint32_t>& seeds);

/// One flight; may throw.
using Fly = std::function<FlightResult(std::uint32_t seed)>;
/// Called for each flight in the order of the seeds, as soon as all before it are done. Never from two
/// threads at once.
using Report = std::function<void(const FlightResult& flight, int done, int total)>;

/// Flies all seeds in `jobs` threads. The order of the reports does not depend on `jobs`.
/// \throws what the first failing flight threw; flights before it are reported
void flyAll(const std::vector<std::uint32_t>& seeds, int jobs, const Fly& fly, const Report& report);

}  // namespace window_ingress::evaluation
