#include "window_ingress/geometry/quadrilateral.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace window_ingress::geometry::quadrilateral_test {

using Eigen::Vector2d;

const Quadrilateral kBox{Vector2d(10, 20), Vector2d(50, 20), Vector2d(50, 40), Vector2d(10, 40)};

TEST(Quadrilateral, CanonicalIsTheSameFromEveryStartAndWinding) {
  const Quadrilateral skewed{Vector2d(10, 22), Vector2d(52, 18), Vector2d(47, 44), Vector2d(12, 39)};
  for (int start = 0; start < 4; ++start)
    for (bool reversed : {false, true}) {
      Quadrilateral quad = skewed;
      std::rotate(quad.begin(), quad.begin() + start, quad.end());
      if (reversed) std::reverse(quad.begin(), quad.end());
      const auto ordered = canonical(quad);
      ASSERT_TRUE(ordered);
      for (int i = 0; i < 4; ++i) EXPECT_EQ((*ordered)[i], skewed[i]);
    }
}

TEST(Quadrilateral, CanonicalRefusesCrossedConcaveCollinearAndNan) {
  EXPECT_FALSE(canonical({kBox[0], kBox[2], kBox[1], kBox[3]}));
  EXPECT_FALSE(canonical({kBox[0], kBox[1], Vector2d(20, 25), kBox[3]}));
  EXPECT_FALSE(canonical({Vector2d(0, 0), Vector2d(1, 1), Vector2d(2, 2), Vector2d(3, 3)}));
  EXPECT_FALSE(canonical({kBox[0], kBox[0], kBox[0], kBox[0]}));
  Quadrilateral nan = kBox;
  nan[2].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(canonical(nan));
}

TEST(Quadrilateral, MeasuresOfABox) {
  EXPECT_DOUBLE_EQ(signedArea(kBox), 800.0);
  EXPECT_DOUBLE_EQ(signedArea({kBox[3], kBox[2], kBox[1], kBox[0]}), -800.0);
  EXPECT_EQ(centroid(kBox), Vector2d(30, 30));
  EXPECT_EQ(sideLengths(kBox), (std::array<double, 4>{40, 20, 40, 20}));
  EXPECT_DOUBLE_EQ(aspectRatio(kBox), 2.0);
  for (double angle : interiorAngles(kBox)) EXPECT_DOUBLE_EQ(angle, M_PI_2);
}

TEST(Quadrilateral, SizesOfABoxForEitherWinding) {
  EXPECT_DOUBLE_EQ(meanSide(kBox), 30.0);
  EXPECT_DOUBLE_EQ(rootArea(kBox), std::sqrt(800.0));
  EXPECT_DOUBLE_EQ(rootArea({kBox[3], kBox[2], kBox[1], kBox[0]}), std::sqrt(800.0));
}

TEST(Quadrilateral, TheFurthestCornerCounts) {
  Quadrilateral other = kBox;
  other[1] += Vector2d(1, 0), other[2] += Vector2d(3, -4);
  EXPECT_DOUBLE_EQ(furthestCorner(kBox, other), 5.0);
  EXPECT_EQ(furthestCorner(kBox, kBox), 0.0);
}

TEST(Quadrilateral, ContainsItsBorderAndNothingOutside) {
  EXPECT_TRUE(contains(kBox, {30, 30}));
  EXPECT_TRUE(contains(kBox, {10, 20}));
  EXPECT_FALSE(contains(kBox, {9.99, 30}));
  EXPECT_FALSE(contains(kBox, {30, 40.01}));
}

TEST(Quadrilateral, IntersectionOverUnionOfShiftedBoxes) {
  Quadrilateral shifted = kBox;
  for (auto& corner : shifted) corner.x() += 20;
  EXPECT_NEAR(intersectionOverUnion(kBox, kBox), 1.0, 1e-12);
  EXPECT_NEAR(intersectionOverUnion(kBox, shifted), 400.0 / 1200.0, 1e-12);
  for (auto& corner : shifted) corner.x() += 40;
  EXPECT_EQ(intersectionOverUnion(kBox, shifted), 0.0);
}

TEST(Quadrilateral, IntersectionOverUnionAgreesWithCountingPixels) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> jitter(-15, 15);
  for (int round = 0; round < 20; ++round) {
    Quadrilateral a{Vector2d(20, 20), Vector2d(80, 20), Vector2d(80, 80), Vector2d(20, 80)}, b = a;
    for (auto& corner : a) corner += Vector2d(jitter(random), jitter(random));
    for (auto& corner : b) corner += Vector2d(jitter(random), jitter(random));
    int both = 0, either = 0;
    for (double y = 0.25; y < 100; y += 0.5)
      for (double x = 0.25; x < 100; x += 0.5) {
        const bool in_a = contains(a, {x, y}), in_b = contains(b, {x, y});
        both += in_a && in_b;
        either += in_a || in_b;
      }
    EXPECT_NEAR(intersectionOverUnion(a, b), double(both) / either, 0.01);
  }
}

}  // namespace window_ingress::geometry::quadrilateral_test
