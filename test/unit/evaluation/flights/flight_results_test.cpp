#include "evaluation/flights/flight_results.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "evaluation/csv.hpp"
#include "refusal.hpp"

namespace window_ingress::evaluation::flight_results_test {

namespace fs = std::filesystem;
using simulation::Outcome;

FlightResult flightWith(std::uint32_t seed) {
  FlightResult flight;
  flight.seed = seed;
  flight.outcome = Outcome::kPassed;
  flight.time_sec = 8.5;
  flight.offset_y_m = -0.0123;
  flight.offset_z_m = 0.0;
  flight.reason = "crossed, \"well\"";
  flight.track = {{0.0, {-5.0, 1.0, 0.25}}, {0.1, {-4.9, 0.9, 0.25}}};
  return flight;
}

class FlightResults : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::vector<FlightResult>& flights) const {
    const fs::path folder = root_.path / name;
    fs::create_directories(folder);
    std::ofstream rows(folder / "flights.csv"), tracks(folder / "tracks.csv");
    rows << csvHeader() << "\n";
    tracks << trackHeader() << "\n";
    for (const auto& flight : flights) {
      rows << csvRow(flight) << "\n";
      tracks << trackRows(flight);
    }
    return folder.string();
  }
  static std::string error(const std::vector<std::string>& folders) {
    return test::refusalOf([&] { joinFlights(folders); });
  }
  test::TemporaryFolder root_;
};

TEST(FlightRow, HasTheColumnsOfTheHeader) {
  EXPECT_EQ(csvHeader(),
            "seed,outcome,time_s,offset_y_m,offset_z_m,min_clearance_m,wrong_side_m,max_speed_mps,blind_s,"
            "predicted_miss_m,reason,nearest_m,forbidden");
  auto flight = flightWith(7);
  flight.min_clearance_m = 0.25;
  flight.predicted_miss_m = 0.1;
  flight.reason = "crossed";
  flight.forbidden = "twist";
  EXPECT_EQ(csvRow(flight),
            "7,PASSED,8.500,-0.0123,0.0000,0.2500,0.0000,0.0000,0.000,0.1000,crossed,0.0000,twist");
}

TEST(FlightRow, LeavesEmptyWhatWasNeverMeasuredAndQuotesText) {
  FlightResult lost;
  lost.outcome = Outcome::kAborted;
  lost.reason = "lost, \"really\"\nlost";
  EXPECT_EQ(csvRow(lost), "0,ABORTED,0.000,,,,0.0000,0.0000,0.000,,\"lost, \"\"really\"\" lost\",0.0000,");
}

TEST_F(FlightResults, ReadsBackWhatItWrote) {
  FlightResult bare;
  bare.seed = 3;
  bare.outcome = Outcome::kTimeout;
  bare.forbidden = "twist, or not";
  const auto read = readFlights(write("a", {flightWith(2), bare}));
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(csvRow(read[0]), csvRow(flightWith(2)));
  EXPECT_EQ(trackRows(read[0]), trackRows(flightWith(2)));
  EXPECT_EQ(csvRow(read[1]), csvRow(bare));
  EXPECT_FALSE(read[1].offset_y_m || read[1].min_clearance_m || read[1].predicted_miss_m);
  EXPECT_TRUE(read[1].track.empty());
}

// A full disk or a killed process leaves a cut row. The flights can be resumed.
TEST_F(FlightResults, LeavesARowOutThatWasCutOff) {
  const fs::path folder = write("a", {flightWith(2)});
  std::ofstream(folder / "flights.csv", std::ios::app) << "3,PASSED,8.500,-0.01";
  std::ofstream(folder / "tracks.csv", std::ios::app) << "3,0.000,1.0000";
  const auto read = readFlights(folder.string());
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(csvRow(read[0]) + trackRows(read[0]), csvRow(flightWith(2)) + trackRows(flightWith(2)));
}

TEST_F(FlightResults, JoinsShardsInTheOrderOfTheirSeeds) {
  const auto joined =
      joinFlights({write("a", {flightWith(2), flightWith(4)}), write("b", {flightWith(1), flightWith(3)})});
  ASSERT_EQ(joined.size(), 4u);
  for (std::uint32_t i = 0; i < 4; ++i) EXPECT_EQ(joined[i].seed, i + 1);
  EXPECT_EQ(joined[2].track.size(), 2u);
}

TEST_F(FlightResults, NamesFileAndLineOfWhatIsWrong) {
  const std::string good = write("good", {flightWith(1)});
  EXPECT_TRUE(test::says(error({good, good}), "seed 1 was flown twice"));
  EXPECT_TRUE(test::says(error({"/nowhere"}), "/nowhere/tracks.csv: cannot be read"));
  std::ofstream(good + "/flights.csv") << csvHeader() << "\n1,PASSED\n";
  EXPECT_TRUE(test::says(error({good}), "flights.csv:2: has not 13 fields"));
  std::ofstream(good + "/flights.csv") << csvHeader() << "\n1,LANDED,1,,,,0,0,0,,x,0,\n";
  EXPECT_TRUE(test::says(error({good}), "flights.csv:2: 'LANDED' is not an outcome"));
  std::ofstream(good + "/flights.csv") << csvHeader() << "\n1,PASSED,soon,,,,0,0,0,,x,0,\n";
  EXPECT_TRUE(test::says(error({good}), "'soon' is not a number"));
  std::ofstream(good + "/flights.csv") << "seed\n1\n";
  EXPECT_TRUE(test::says(error({good}), "flights.csv:1: is not 'seed,outcome"));
}

TEST_F(FlightResults, DrawsAreReadByKeyAndSeedAndRefusedWithTheirLine) {
  const auto errorOf = [&](const std::string& text) {
    return test::refusalOf([&] { readDraws(root_.write("draws.csv", text)); });
  };
  EXPECT_EQ(errorOf("seed,wind/x_mps\n3,0.25\n9,1\n"), "");
  const FlightDraws draws = readDraws(root_.path / "draws.csv");
  ASSERT_EQ(draws.size(), 2u);
  EXPECT_EQ(draws.at(3).at("wind/x_mps"), 0.25);
  EXPECT_TRUE(test::says(errorOf("wind/x_mps\n0.5\n"), "must begin with 'seed'"));
  EXPECT_TRUE(test::says(errorOf("seed,wind/x_mps\n3,0.2\n3,0.3\n"), ":3: seed 3 is listed twice"));
  EXPECT_TRUE(test::says(errorOf("seed,wind/x_mps\n3\n"), ":2: "));
  for (const char* quantile : {"nan", "1.5", "-0.1"})
    EXPECT_TRUE(test::says(errorOf(std::string("seed,wind/x_mps\n3,") + quantile), "is not from 0 to 1"));
  for (const char* seed : {"-1", "0.5", "nan", "1e10"})
    EXPECT_TRUE(
        test::says(errorOf(std::string("seed,wind/x_mps\n") + seed + ",0.5"), "is not a whole number"));
}

}  // namespace window_ingress::evaluation::flight_results_test
