#include "evaluation/statistics.hpp"

#include <gtest/gtest.h>

namespace window_ingress::evaluation::statistics_test {

TEST(Wilson95, AgreesWithPublishedValues) {
  // Newcombe (1998), table I: 81 of 263 and 0 of 20.
  EXPECT_NEAR(wilson95(81, 263).low, 0.2553, 5e-5);
  EXPECT_NEAR(wilson95(81, 263).high, 0.3662, 5e-5);
  EXPECT_NEAR(wilson95(0, 20).low, 0.0, 1e-12);
  EXPECT_NEAR(wilson95(0, 20).high, 0.1611, 5e-5);
}

TEST(Wilson95, OfNothingIsEverything) {
  EXPECT_EQ(wilson95(0, 0).low, 0.0);
  EXPECT_EQ(wilson95(0, 0).high, 1.0);
}

TEST(Quantile, IsLinearBetweenNeighbours) {
  EXPECT_DOUBLE_EQ(quantile({3, 1, 2}, 0.5), 2.0);
  EXPECT_DOUBLE_EQ(quantile({0, 10}, 0.25), 2.5);
  EXPECT_DOUBLE_EQ(quantile({4}, 0.9), 4.0);
  EXPECT_DOUBLE_EQ(quantile({}, 0.5), 0.0);
}

}  // namespace window_ingress::evaluation::statistics_test
