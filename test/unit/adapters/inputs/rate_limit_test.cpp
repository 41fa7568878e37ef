#include "adapters/inputs/rate_limit.hpp"

#include <gtest/gtest.h>

#include <random>

namespace window_ingress::adapters::rate_limit_test {

int admittedOf(int messages, double message_hz, double max_hz) {
  RateLimit limit(max_hz);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> jitter_sec(-0.1 / message_hz, 0.1 / message_hz);
  int admitted = 0;
  for (int i = 0; i < messages; ++i)
    admitted += limit.admits(1000.0 + i / message_hz + jitter_sec(random)) ? 1 : 0;
  return admitted;
}

TEST(RateLimit, HoldsOnAverageWhateverTheSourcesRate) {
  for (const double max_hz : {1.0, 7.0, 10.0, 15.0, 25.0, 29.0})
    EXPECT_NEAR(admittedOf(3000, 30.0, max_hz), 100.0 * max_hz, 0.01 * 100.0 * max_hz + 2.0) << max_hz;
}

TEST(RateLimit, AdmitsAllOfASlowerSourceAndAllWithoutALimit) {
  EXPECT_EQ(admittedOf(300, 10.0, 15.0), 300);
  EXPECT_EQ(admittedOf(300, 30.0, 0.0), 300);
}

TEST(RateLimit, GoesOnAfterAClockThatJumpedBack) {
  RateLimit limit(10.0);
  EXPECT_TRUE(limit.admits(1000.0));
  EXPECT_TRUE(limit.admits(5.0));
  EXPECT_FALSE(limit.admits(5.05));
  EXPECT_TRUE(limit.admits(5.11));
}

}  // namespace window_ingress::adapters::rate_limit_test
