#include "evaluation/flights/flight_summary.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "window_ingress/text/text.hpp"

namespace window_ingress::evaluation {
namespace {

bool hasPassed(const FlightResult& flight) { return flight.outcome == simulation::Outcome::kPassed; }

}  // namespace

FlightSummary summarise(const std::vector<FlightResult>& flights) {
  FlightSummary summary;
  std::vector<double> times, offsets, wrong_sides;
  for (const auto& flight : flights) {
    const std::string outcome = toString(flight.outcome);
    ++summary.outcomes[outcome];
    wrong_sides.push_back(flight.wrong_side_m);
    if (hasPassed(flight)) times.push_back(flight.time_sec);
    if (!hasPassed(flight)) ++summary.causes[outcome + ": " + withoutNumbers(flight.reason)];
    if (flight.offset_y_m && flight.offset_z_m) {
      offsets.push_back(std::max(std::abs(*flight.offset_y_m), std::abs(*flight.offset_z_m)));
    }
  }
  summary.flights = static_cast<int>(flights.size());
  summary.passed = static_cast<int>(times.size());
  summary.pass_rate_95 = wilson95(summary.passed, summary.flights);
  summary.median_time_sec = quantile(times, 0.5);
  summary.p95_time_sec = quantile(times, 0.95);
  summary.p95_offset_m = quantile(offsets, 0.95);
  summary.p95_wrong_side_m = quantile(wrong_sides, 0.95);
  return summary;
}

std::string toJson(const FlightSummary& summary, const CampaignFacts& facts) {
  nlohmann::json json;
  json["scenario"] = facts.scenario;
  json["seeds"] = facts.seeds;
  json["draws"] = facts.draws;
  json["params"] = facts.params;
  json["pictures"] = facts.with_images;
  json["version"] = facts.version;
  json["flights"] = summary.flights;
  json["passed"] = summary.passed;
  json["pass_rate"] = summary.flights > 0 ? static_cast<double>(summary.passed) / summary.flights : 0.0;
  json["pass_rate_low_95"] = summary.pass_rate_95.low;
  json["pass_rate_high_95"] = summary.pass_rate_95.high;
  json["outcomes"] = summary.outcomes;
  json["causes"] = summary.causes;
  json["median_time_s"] = summary.median_time_sec;
  json["p95_time_s"] = summary.p95_time_sec;
  json["p95_offset_m"] = summary.p95_offset_m;
  json["p95_wrong_side_m"] = summary.p95_wrong_side_m;
  return json.dump(2) + "\n";
}

}  // namespace window_ingress::evaluation
