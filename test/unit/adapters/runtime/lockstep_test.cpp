#include "adapters/runtime/lockstep.hpp"

#include <gtest/gtest.h>

#include "adapters/world/world_referee.hpp"

namespace window_ingress::adapters::lockstep_test {

TEST(Lockstep, TheClockDoesNotDecideAboutMessagesThere) {
  StampGate usual(limitsFor(false, {})), lockstep(limitsFor(true, {}));
  EXPECT_TRUE(usual.whyRefused(ros::Time(100.0), 101.0));
  EXPECT_FALSE(lockstep.whyRefused(ros::Time(100.0), 101.0));
  EXPECT_TRUE(lockstep.whyRefused(ros::Time(100.0), 101.0)) << "the same once more";
  EXPECT_TRUE(lockstep.whyRefused(ros::Time(), 101.0));
}

TEST(Lockstep, NothingIsLostThere) {
  EXPECT_EQ(queueFor(false, 1), 1);
  EXPECT_GE(queueFor(true, 1), 400) << "a second of the fastest sensor";
}

TEST(VerdictFile, SaysWhatIsKnownAndNullForWhatIsNot) {
  window_ingress::FlightVerdict verdict;
  verdict.outcome_name = "TIMEOUT";
  verdict.reason = "not \"done\" by then";
  verdict.offset_y = 0.25;
  std::string json = toJson(verdict);
  EXPECT_NE(json.find("\"outcome\": \"TIMEOUT\""), std::string::npos) << json;
  EXPECT_NE(json.find("\"offset_y_m\": null"), std::string::npos) << json;
  EXPECT_NE(json.find("not \\\"done\\\" by then"), std::string::npos) << json;
  verdict.crossed = true;
  EXPECT_NE(toJson(verdict).find("\"offset_y_m\": 0.25"), std::string::npos);
}

}  // namespace window_ingress::adapters::lockstep_test
