#include "window_ingress/detection/direction_bins.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace window_ingress::detection {
namespace {

constexpr double kTwoPi = 6.283185307179586;

int byAngle(int x, int y) {
  const double turns = std::atan2(y, x) / kTwoPi;
  return (static_cast<int>(std::lround(turns * DirectionBins::kCount)) + DirectionBins::kCount) %
         DirectionBins::kCount;
}

TEST(DirectionBins, AgreeWithTheAngleForAllSmallVectors) {
  const DirectionBins bins;
  for (int y = -260; y <= 260; ++y)
    for (int x = -260; x <= 260; ++x) ASSERT_EQ(bins.of(x, y), byAngle(x, y)) << x << ", " << y;
}

TEST(DirectionBins, AgreeWithTheAngleForLargeVectors) {
  const DirectionBins bins;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> component(-32768, 32767);
  for (int i = 0; i < 200000; ++i) {
    const int x = component(random), y = component(random);
    ASSERT_EQ(bins.of(x, y), byAngle(x, y)) << x << ", " << y;
  }
}

TEST(DirectionBins, EachDirectionFallsIntoItsOwnBin) {
  const DirectionBins bins;
  for (int i = 0; i < DirectionBins::kCount; ++i) {
    EXPECT_NEAR(bins.direction(i).norm(), 1.0, 1e-15);
    EXPECT_EQ(bins.of(std::lround(20000 * bins.direction(i).x()), std::lround(20000 * bins.direction(i).y())),
              i);
  }
}

TEST(DirectionBins, TheNullVectorHasABinToo) { EXPECT_EQ(DirectionBins().of(0, 0), 0); }

}  // namespace
}  // namespace window_ingress::detection
