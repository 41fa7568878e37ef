#include "detection/borders/lines.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

namespace window_ingress::detection::lines_test {

/// Points along a line with noise across it; every n-th point is an outlier.
struct Sample {
  Sample(const OffsetLine& truth, double sigma_px, int outlier_every, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> noise(0.0, sigma_px);
    for (int i = -40; i <= 40; ++i) {
      const bool is_outlier = outlier_every > 0 && i % outlier_every == 0;
      positions.push_back(i);
      offsets.push_back(truth.at(i) + (is_outlier ? 6.0 : noise(random)));
    }
  }
  void fit(double scale_px, OffsetLine& line) const { fitRobustLine(positions, offsets, scale_px, line); }
  std::vector<double> positions, offsets;
};

TEST(RobustLine, IsExactWithoutNoiseAtEverySlope) {
  for (double slope = -0.3; slope < 0.3; slope += 0.05) {
    OffsetLine line{0.5, slope + 0.01};
    Sample({0.3, slope}, 0.0, 0, 1).fit(1.0, line);
    EXPECT_NEAR(line.offset, 0.3, 1e-9);
    EXPECT_NEAR(line.slope, slope, 1e-9);
  }
}

TEST(RobustLine, OutliersOnOneSideDoNotPull) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    OffsetLine line{0.5, 0.02};
    Sample({0.0, 0.0}, 0.1, 4, seed).fit(0.5, line);
    EXPECT_NEAR(line.offset, 0.0, 0.06);
    EXPECT_NEAR(line.slope, 0.0, 0.003);
  }
}

TEST(RobustLine, SpreadOfManyFitsIsThatOfLeastSquares) {
  double squares = 0.0;
  const int trials = 400;
  for (int seed = 0; seed < trials; ++seed) {
    OffsetLine line;
    Sample({0.2, 0.01}, 0.1, 0, 100 + seed).fit(0.6, line);
    squares += std::pow(line.offset - 0.2, 2) / trials;
  }
  EXPECT_NEAR(std::sqrt(squares), 0.1 / std::sqrt(81.0), 0.002);
}

TEST(RobustLine, TooFewOrCoincidingPointsLeaveTheStart) {
  OffsetLine line{3.0, 0.1};
  fitRobustLine({}, {}, 1.0, line);
  Sample same({0.0, 0.0}, 0.0, 0, 1);
  same.positions.assign(same.positions.size(), 5.0);
  same.fit(1.0, line);
  EXPECT_EQ(line.offset, 3.0);
  EXPECT_EQ(line.slope, 0.1);
}

}  // namespace window_ingress::detection::lines_test
