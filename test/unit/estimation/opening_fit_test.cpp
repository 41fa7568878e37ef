#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "window_ingress/estimation/size_estimate.hpp"

namespace window_ingress::estimation::opening_fit_test {

const geometry::OpeningSize kNeeded{0.60, 0.34};

SizeEstimate opening(double width_m, double height_m, double sigma) {
  return {{width_m, height_m}, sigma * sigma * Eigen::Matrix2d::Identity()};
}

TEST(OpeningFit, NeedsVehicleAndBothMargins) {
  EXPECT_EQ(fitVerdict(opening(0.61, 0.40, 0.001), kNeeded).fit, Fit::kGo);
  EXPECT_EQ(fitVerdict(opening(0.59, 0.40, 0.001), kNeeded).fit, Fit::kNoGo);
  EXPECT_EQ(fitVerdict(opening(1.20, 0.33, 0.001), kNeeded).fit, Fit::kNoGo);
  EXPECT_EQ(fitVerdict(opening(0.60, 0.40, 0.001), kNeeded).fit, Fit::kUnknown);
  EXPECT_EQ(fitVerdict(opening(1.20, 1.00, 0.500), kNeeded).fit, Fit::kUnknown);
}

TEST(OpeningFit, NamesTheSideThatDecidesWithNumbers) {
  const auto verdict = fitVerdict(opening(1.20, 0.30, 0.01), kNeeded);
  EXPECT_NE(verdict.reason.find("height 0.300"), std::string::npos) << verdict.reason;
  EXPECT_NE(verdict.reason.find("0.340"), std::string::npos) << verdict.reason;
}

TEST(OpeningFit, IsRightWheneverTheTruthIsFarFromTheLimit) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::uniform_real_distribution<double> width(0.4, 0.9), sigma(0.005, 0.05);
  int judged = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const double truth = width(random), spread = sigma(random);
    const auto verdict = fitVerdict(opening(truth * std::exp(spread * normal(random)), 1.0, spread), kNeeded);
    const bool fits = truth > 0.6;
    if (std::abs(std::log(truth / 0.6)) < 2.0 * spread) continue;
    ++judged;
    EXPECT_NE(verdict.fit, fits ? Fit::kNoGo : Fit::kGo) << truth << " +- " << spread * truth;
  }
  EXPECT_GT(judged, 10000);
}

TEST(OpeningFit, OfNoSizeNothingIsSaid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(fitVerdict(opening(nan, 1.0, 0.01), kNeeded).fit, Fit::kUnknown);
  EXPECT_EQ(fitVerdict(opening(0.0, 1.0, 0.01), kNeeded).fit, Fit::kUnknown);
  EXPECT_EQ(fitVerdict(opening(1.0, 1.0, nan), kNeeded).fit, Fit::kUnknown);
  EXPECT_EQ(fitVerdict(opening(1.0, 1.0, std::numeric_limits<double>::infinity()), kNeeded).fit,
            Fit::kUnknown);
}

}  // namespace window_ingress::estimation::opening_fit_test
