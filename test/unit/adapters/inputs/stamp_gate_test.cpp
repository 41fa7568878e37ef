#include "adapters/inputs/stamp_gate.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::stamp_gate_test {

TEST(StampGate, AdmitsRecentStampsInOrder) {
  StampGate gate{StampLimits{}};
  EXPECT_FALSE(gate.whyRefused(ros::Time(100.0), 100.1));
  EXPECT_FALSE(gate.whyRefused(ros::Time(100.1), 100.1));
  EXPECT_TRUE(gate.whyRefused(ros::Time(100.1), 100.1)) << "duplicate";
  EXPECT_TRUE(gate.whyRefused(ros::Time(100.05), 100.1)) << "out of order";
  EXPECT_FALSE(gate.whyRefused(ros::Time(100.264), 100.1))
      << "as far ahead of the clock as autopilots have been seen";
}

TEST(StampGate, RefusesOldFutureAndExtremeStampsWithoutThrowing) {
  StampGate gate{StampLimits{}};
  EXPECT_TRUE(gate.whyRefused(ros::Time(95.0), 100.0));
  EXPECT_TRUE(gate.whyRefused(ros::Time(105.0), 100.0));
  EXPECT_TRUE(gate.whyRefused(ros::Time(), 100.0));
  EXPECT_TRUE(gate.whyRefused(ros::Time(4294967295u, 0), 100.0))
      << "beyond 2^31 s roscpp's difference throws";
  EXPECT_TRUE(gate.whyRefused(ros::Time(1.0), 4294967295.0));
}

TEST(StampGate, TellsOfABagPlayedWithoutSimulatedTime) {
  StampGate gate{StampLimits{}};
  EXPECT_NE(gate.whyRefused(ros::Time(1700000000.0), 1790000000.0)->find("use_sim_time"), std::string::npos);
}

TEST(StampGate, TellsOfSimulatedTimeBesideARealSource) {
  StampGate gate{StampLimits{}};
  const std::string reason = *gate.whyRefused(ros::Time(1790000000.0), 100.0);
  EXPECT_NE(reason.find("20718 days ahead of the clock; is use_sim_time set"), std::string::npos) << reason;
  EXPECT_NE(gate.whyRefused(ros::Time(1790000000.0), 1789999990.0)->find("10.00 s ahead"), std::string::npos);
}

TEST(StampGate, TellsOfAPlayerThatIsTooSlowWhereTimeIsSimulated) {
  StampGate gate{StampLimits{}};
  ros::Time::init();
  EXPECT_EQ(gate.whyRefused(ros::Time(100.3), 100.0)->find("player"), std::string::npos);
  ros::Time::setNow(ros::Time(100.0));
  EXPECT_NE(gate.whyRefused(ros::Time(100.3), 100.0)->find("its player is too slow: rosbag decompress"),
            std::string::npos);
  ros::Time::init();
}

TEST(StampGate, SaysThatSimulatedTimeHasNotBegun) {
  StampGate gate{StampLimits{}};
  EXPECT_EQ(*gate.whyRefused(ros::Time(1700000000.0), 0.0),
            "the clock has not begun: nothing has come on /clock yet");
  EXPECT_EQ(*gate.whyRefused(ros::Time(100.0), 0.0),
            "the clock has not begun: nothing has come on /clock yet");
  EXPECT_FALSE(gate.whyRefused(ros::Time(0.05), 0.0)) << "a simulation that begins at zero";
}

TEST(StampGate, StartsAnewWhenTheClockJumpsBack) {
  StampGate gate{StampLimits{}};
  EXPECT_FALSE(gate.whyRefused(ros::Time(200.0), 200.0));
  EXPECT_FALSE(gate.whyRefused(ros::Time(149.0), 149.0));
}

TEST(ClockWatch, NoticesEachJumpBackOnce) {
  ClockWatch clock;
  EXPECT_FALSE(clock.jumpedBack(100.0));
  EXPECT_FALSE(clock.jumpedBack(99.95)) << "jitter is no jump";
  EXPECT_FALSE(clock.jumpedBack(1050.0)) << "forward is no jump back";
  EXPECT_TRUE(clock.jumpedBack(999.0));
  EXPECT_FALSE(clock.jumpedBack(999.1));
}

}  // namespace window_ingress::adapters::stamp_gate_test
