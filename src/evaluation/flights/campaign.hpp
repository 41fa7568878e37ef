#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/flights/flight_results.hpp"

namespace window_ingress::evaluation {

/// "A..B" (both included) or "A"; nothing if it is neither, or if there are more than a million seeds.
std::optional<std::vector<std::uint32_t>> parseSeeds(const std::string& text);

/// For "I/N" with I from 1 to N: every N-th element from the I-th on; nothing for any other text.
std::optional<std::vector<std::uint32_t>> shardOf(const std::vector<std::uint32_t>& seeds,
                                                  const std::string& text);

/// The inverse of `parseSeeds`: "1..20, 25".
std::string seedsText(const std::vector<std::uint32_t>& seeds);

/// One flight; may throw.
using Fly = std::function<FlightResult(std::uint32_t seed)>;
/// Called for each flight in the order of the seeds, once all before it are done. Never by two threads at
/// once.
using Report = std::function<void(const FlightResult& flight, int done, int total)>;

/// Flies all seeds in `jobs` threads. The order of the reports does not depend on `jobs`.
/// \throws the exception of the first failing flight; flights before it are reported
void flyAll(const std::vector<std::uint32_t>& seeds, int jobs, const Fly& fly, const Report& report);

}  // namespace window_ingress::evaluation
