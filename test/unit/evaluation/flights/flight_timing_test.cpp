#include <gtest/gtest.h>

#include "evaluation/flights/closed_loop_flight.hpp"

namespace window_ingress::evaluation::flight_timing_test {

TEST(FlightTiming, GivesEachLapToItsStageAndSumsUp) {
  FlightTiming timing;
  const auto began = FlightTiming::Clock::now();
  while (std::chrono::duration<double>(FlightTiming::Clock::now() - began).count() < 0.01) {
  }
  timing.lap(Stage::kImage);
  timing.lap(Stage::kPose);
  EXPECT_GE(timing.totalSec(), 0.0099);
  EXPECT_NE(timing.table().find("| detector | 0.00 | 0 % |"), std::string::npos) << timing.table();
  EXPECT_EQ(timing.table().find("| image: rendering, camera | 0.00"), std::string::npos) << timing.table();
  timing.countFrame();
  timing.addSimulated(1.5);
  FlightTiming sum;
  sum.add(timing);
  sum.add(timing);
  EXPECT_EQ(sum.frames(), 2);
  EXPECT_DOUBLE_EQ(sum.simulatedSec(), 3.0);
  EXPECT_DOUBLE_EQ(sum.totalSec(), 2.0 * timing.totalSec());
}

TEST(FlightTiming, TableNamesEveryStageAlsoWithoutAFlight) {
  const std::string text = FlightTiming().table();
  for (const char* name : {"physics", "image", "detector", "pose", "navigator", "rest", "times real time"})
    EXPECT_NE(text.find(name), std::string::npos) << name;
  EXPECT_EQ(text.find("nan"), std::string::npos);
}

}  // namespace window_ingress::evaluation::flight_timing_test
