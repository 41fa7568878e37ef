#include "detection/reference/haze.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "detection/reference/ring_colours.hpp"

namespace window_ingress::detection::haze_test {

using Eigen::Vector3f;

const Vector3f kWall(137, 154, 163), kOrange(16, 78, 185), kOchre(45, 115, 185), kFog(200, 196, 190);

Vector3f through(const Vector3f& colour, float left) { return left * colour + (1.0F - left) * kFog; }

RingMeans ring(const Vector3f& frame, double darkest, double sigma = 0.5) {
  return {frame, kWall, sigma, darkest};
}

RingMeans foggy(const Vector3f& frame, float left) {
  return {through(frame, left), through(kWall, left), 0.5, (1.0 - left) * 190.0};
}

TEST(Haze, IsTakenOff) {
  for (float left : {0.1F, 0.3F, 0.6F}) {
    const auto haze = hazeThatLeaves(left, kWall, through(kWall, left), 190.0);
    ASSERT_TRUE(haze) << left;
    EXPECT_LT((haze->off(through(kOrange, left)) - kOrange).norm(), 0.1F);
    EXPECT_LT((haze->added - (1.0F - left) * kFog).norm(), 0.01F);
  }
}

TEST(Haze, NoneThatIsColouredOrBrighterThanTheDarkestPlaceOrThin) {
  EXPECT_FALSE(hazeThatLeaves(0.3, kWall, through(kWall, 0.3F), 90.0)) << "a darker place is seen";
  EXPECT_FALSE(hazeThatLeaves(0.3, kWall, {60, 140, 190}, 190.0)) << "orange light";
  EXPECT_FALSE(hazeThatLeaves(0.95, kWall, through(kWall, 0.95F), 190.0));
  EXPECT_FALSE(hazeThatLeaves(0.01, kWall, through(kWall, 0.01F), 190.0));
  EXPECT_FALSE(hazeThatLeaves(-1.0, kWall, kWall, 190.0));
  EXPECT_FALSE(hazeThatLeaves(std::numeric_limits<double>::quiet_NaN(), kWall, kWall, 190.0));
}

TEST(DistanceThroughHaze, TheSamePaintIsNearAndAnotherIsFar) {
  const RingMeans reference = ring(kOrange, 10.0);
  for (float left : {0.15F, 0.3F, 0.6F}) {
    const auto same = distanceThroughHaze(reference, foggy(kOrange, left));
    ASSERT_TRUE(same) << left;
    EXPECT_LT(*same, 0.1);
    const auto other = distanceThroughHaze(reference, foggy(kOchre, left));
    EXPECT_TRUE(!other || *other > 0.5) << left;
    EXPECT_FALSE(distanceThroughHaze(reference, foggy({240, 240, 235}, left)).value_or(1.0) < 0.9);
  }
}

TEST(DistanceThroughHaze, TellsNothingInClearAirInNoiseOrOfAFramelessReference) {
  const RingMeans reference = ring(kOrange, 10.0);
  EXPECT_FALSE(distanceThroughHaze(reference, ring(kOchre, 20.0))) << "paler paint in clear air";
  RingMeans noisy = foggy(kOrange, 0.15F);
  noisy.sigma = 10.0;
  EXPECT_FALSE(distanceThroughHaze(reference, noisy));
  EXPECT_FALSE(distanceThroughHaze(ring(kWall, 10.0), foggy(kWall, 0.3F)));
}

}  // namespace window_ingress::detection::haze_test
