// Proves that this package's compiler flags preserve NaN and infinity.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

TEST(Compiler, IsfiniteTellsNanAndInfinityFromNumbers) {
  volatile double zero = 0.0;  // prevents constant folding
  EXPECT_FALSE(std::isfinite(zero / zero));
  EXPECT_FALSE(std::isfinite(1.0 / zero));
  EXPECT_FALSE(std::isfinite(static_cast<double>(zero + std::numeric_limits<double>::quiet_NaN())));
  EXPECT_TRUE(std::isfinite(1.0 + zero));
}
