#include "adapters/navigator/engagement_monitor.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace window_ingress::adapters::engagement_monitor_test {

TEST(EngagementMonitor, IsTakenForGrantedWhereNobodySaysUnlessRequired) {
  EngagementParams params;
  EXPECT_TRUE(EngagementMonitor(params).holds(1e6));
  params.required = true;
  const EngagementMonitor required(params);
  EXPECT_FALSE(required.holds(1e6));
  const Health health = required.health("/engaged", 1e6);
  EXPECT_EQ(health.level, Health::kError);
  EXPECT_NE(health.text.find("/engaged"), std::string::npos);
}

TEST(EngagementMonitor, AStartIsNoFaultUntilTheOthersHaveHadTheTimeToStart) {
  EngagementParams params;
  params.required = true;
  const EngagementMonitor engagement(params, 100.0);
  const Health early = engagement.health("/engaged", 102.9);
  EXPECT_EQ(early.level, Health::kOk);
  EXPECT_EQ(early.text, "waiting for /engaged");
  EXPECT_FALSE(engagement.holds(102.9));
  EXPECT_EQ(engagement.health("/engaged", 103.1).level, Health::kError);
}

TEST(EngagementMonitor, OnceHeardOnlyARecentYesIsAYes) {
  EngagementMonitor engagement{EngagementParams()};
  engagement.hear(true, 10.0);
  EXPECT_TRUE(engagement.holds(10.0));
  EXPECT_TRUE(engagement.holds(13.0));
  EXPECT_FALSE(engagement.holds(13.01));
  EXPECT_EQ(engagement.health("/engaged", 13.01).level, Health::kError);
  engagement.hear(true, 20.0);
  EXPECT_TRUE(engagement.holds(20.0));
  engagement.hear(false, 20.5);
  EXPECT_FALSE(engagement.holds(20.5));
  EXPECT_EQ(engagement.health("/engaged", 20.5).level, Health::kOk);
  EXPECT_FALSE(engagement.holds(std::numeric_limits<double>::quiet_NaN()));
}

TEST(EngagementMonitor, WarnsOfASecondSource) {
  EngagementMonitor engagement(EngagementParams(), 0.0);
  engagement.hear(true, 1.0);
  EXPECT_EQ(engagement.health("/engaged", 1.0, 1).level, Health::kOk);
  EXPECT_EQ(engagement.health("/engaged", 1.0, 2).level, Health::kWarn);
  EXPECT_EQ(engagement.health("/engaged", 9.0, 2).level, Health::kError) << "what is worse is said";
}

TEST(EngagementMonitor, NeverHoldsLongerThanTheLastYes) {
  EngagementParams params;
  EngagementMonitor engagement(params);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double now = 0.0, yes = -1e9;
  bool last = false;
  engagement.hear(false, now);
  for (int i = 0; i < 10000; ++i) {
    now += 2.0 * unit(random);
    if (unit(random) < 0.5) {
      last = unit(random) < 0.7;
      engagement.hear(last, now);
      if (last) yes = now;
    }
    ASSERT_EQ(engagement.holds(now), last && now - yes <= params.max_silence_sec);
  }
}

}  // namespace window_ingress::adapters::engagement_monitor_test
