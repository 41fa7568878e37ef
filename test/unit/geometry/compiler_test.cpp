// Proves that the flags this package is built with leave NaN and infinity alone.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

TEST(Compiler, IsfiniteTellsNanAndInfinityFromNumbers) {
  volatile double zero = 0.0;  // keeps the compiler from folding the question away
  EXPECT_FALSE(std::isfinite(zero / zero));
  EXPECT_FALSE(std::isfinite(1.0 / zero));
  EXPECT_FALSE(std::isfinite(static_cast<double>(zero + std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isfinite(1.0 + zero));
}
