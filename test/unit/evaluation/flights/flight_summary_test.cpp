#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "evaluation/flights/flight_results.hpp"
#include "evaluation/statistics.hpp"

namespace window_ingress::evaluation::flight_summary_test {

using simulation::Outcome;

FlightResult passed(std::uint32_t seed, double time_sec, double offset_m) {
  FlightResult flight;
  flight.seed = seed;
  flight.outcome = Outcome::kPassed;
  flight.time_sec = time_sec;
  flight.offset_y_m = offset_m;
  flight.offset_z_m = 0.0;
  return flight;
}

FlightResult failed(Outcome outcome, const std::string& reason) {
  FlightResult flight;
  flight.outcome = outcome;
  flight.reason = reason;
  return flight;
}

TEST(FlightSummary, OfNothingSaysNothing) {
  const auto summary = nlohmann::json::parse(toJson({}, {}));
  EXPECT_EQ(summary["flights"], 0);
  EXPECT_EQ(summary["pass_rate_low_95"], 0.0);
  EXPECT_EQ(summary["pass_rate_high_95"], 1.0);
  EXPECT_EQ(summary["pass_rate"], 0.0);
  EXPECT_TRUE(summary["causes"].is_object());
}

TEST(FlightSummary, CountsOutcomesAndLikeCausesTogether) {
  std::vector<FlightResult> flights;
  for (std::uint32_t seed = 1; seed <= 8; ++seed) flights.push_back(passed(seed, seed, 0.01 * seed));
  flights.push_back(failed(Outcome::kAborted, "gave up at 12.30 s"));
  flights.push_back(failed(Outcome::kAborted, "gave up at 9.75 s"));
  const auto json = nlohmann::json::parse(
      toJson(flights, {"a.yaml", "1..10", "", "b.yaml", false, "1.2.3", {"not used: x"}}));
  EXPECT_EQ(json["warnings"][0], "not used: x");
  EXPECT_EQ(json["scenario"], "a.yaml");
  EXPECT_EQ(json["seeds"], "1..10");
  EXPECT_EQ(json["draws"], "");
  EXPECT_EQ(json["params"], "b.yaml");
  EXPECT_EQ(json["pictures"], false);
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["flights"], 10);
  EXPECT_EQ(json["passed"], 8);
  EXPECT_EQ(json["outcomes"]["ABORTED"], 2);
  EXPECT_EQ(json["causes"]["ABORTED: gave up at # s"], 2);
  EXPECT_DOUBLE_EQ(json["median_time_s"], 4.5);
  EXPECT_NEAR(json["pass_rate_low_95"], wilson95(8, 10).low, 1e-12);
  EXPECT_NEAR(json["p95_offset_m"], 0.0765, 1e-9);
}

TEST(FlightSummary, SurvivesNumbersThatAreNone) {
  auto flight = passed(1, std::numeric_limits<double>::infinity(), 0.0);
  flight.wrong_side_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(toJson({flight}, {}));
}

}  // namespace window_ingress::evaluation::flight_summary_test
