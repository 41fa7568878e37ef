#include "navigation/mission/mission_clock.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace window_ingress::navigation::mission_clock_test {

TEST(MissionClock, CountsTimeButNoJumps) {
  MissionClock clock;
  clock.startMission(100.0);
  clock.enterState();
  for (int i = 1; i <= 10; ++i) clock.pass(100.0 + 0.1 * i);
  clock.enterState();
  clock.pass(101.5);
  EXPECT_NEAR(clock.inMissionSec(), 1.5, 1e-9);
  EXPECT_NEAR(clock.inStateSec(), 0.5, 1e-9);
  clock.pass(201.5);  // one second of it may be true
  EXPECT_NEAR(clock.inMissionSec(), 2.5, 1e-9);
  clock.pass(50.0);
  EXPECT_NEAR(clock.inMissionSec(), 2.5, 1e-9);
  clock.pass(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(clock.nowSec(), 50.0);
}

}  // namespace window_ingress::navigation::mission_clock_test
