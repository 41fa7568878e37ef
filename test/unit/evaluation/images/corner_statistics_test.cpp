#include "evaluation/images/corner_statistics.hpp"

#include <gtest/gtest.h>

#include <random>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation::corner_statistics_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;

const Quadrilateral kTruth{Vector2d(100, 50), Vector2d(300, 50), Vector2d(300, 200), Vector2d(100, 200)};

Quadrilateral moved(Quadrilateral quad, const Vector2d& by) {
  for (auto& corner : quad) corner += by;
  return quad;
}

Quadrilateral grown(double by_px) {
  Quadrilateral quad = kTruth;
  const std::array<Vector2d, 4> out{Vector2d(-1, -1), Vector2d(1, -1), Vector2d(1, 1), Vector2d(-1, 1)};
  for (int i = 0; i < 4; ++i) quad[i] += by_px * out[i];
  return quad;
}

TEST(CornerStatistics, ShiftIsMeanAndRmsButNotOutward) {
  CornerStatistics statistics;
  statistics.add(moved(kTruth, {3.0, -4.0}), kTruth);
  EXPECT_EQ(statistics.frames(), 1);
  EXPECT_NEAR((statistics.mean() - Vector2d(3.0, -4.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((statistics.rms() - Vector2d(3.0, 4.0)).norm(), 0.0, 1e-12);
  EXPECT_NEAR(statistics.median(), 5.0, 1e-12);
  EXPECT_NEAR(statistics.worst(), 5.0, 1e-12);
  EXPECT_NEAR(statistics.outward(), 0.0, 1e-12);
}

TEST(CornerStatistics, GrowthIsOutwardButHasNoMean) {
  for (const double by_px : {0.7, -0.7}) {
    CornerStatistics statistics;
    statistics.add(grown(by_px), kTruth);
    EXPECT_NEAR(statistics.outward(), by_px, 1e-12);
    EXPECT_NEAR(statistics.mean().norm(), 0.0, 1e-12);
    EXPECT_NEAR(statistics.rms().x(), 0.7, 1e-12);
  }
}

TEST(CornerStatistics, OppositeErrorsCancelInTheMeanOnly) {
  CornerStatistics statistics;
  statistics.add(moved(kTruth, {0.5, 0.0}), kTruth);
  statistics.add(moved(kTruth, {-0.5, 0.0}), kTruth);
  EXPECT_EQ(statistics.frames(), 2);
  EXPECT_NEAR(statistics.mean().norm(), 0.0, 1e-12);
  EXPECT_NEAR(statistics.rms().x(), 0.5, 1e-12);
  EXPECT_NEAR(statistics.rms().y(), 0.0, 1e-12);
}

TEST(CornerStatistics, RmsOfNoiseIsItsSigma) {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 0.2);
  CornerStatistics statistics;
  for (int i = 0; i < 3000; ++i) {
    Quadrilateral found = kTruth;
    for (auto& corner : found) corner += Vector2d(noise(random), 3.0 * noise(random));
    statistics.add(found, kTruth);
  }
  EXPECT_NEAR(statistics.rms().x(), 0.2, 0.01);
  EXPECT_NEAR(statistics.rms().y(), 0.6, 0.02);
  EXPECT_NEAR(statistics.outward(), 0.0, 0.02);
}

TEST(CornerStatistics, OfNothingIsZero) {
  const CornerStatistics nothing;
  EXPECT_EQ(nothing.frames(), 0);
  EXPECT_EQ(nothing.rms().norm() + nothing.mean().norm() + nothing.outward() + nothing.median(), 0.0);
}

}  // namespace window_ingress::evaluation::corner_statistics_test
