#include "evaluation/poses/filter_survey.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "window_ingress/estimation/size_estimate.hpp"

namespace window_ingress::evaluation::filter_survey_test {

TEST(FilterSurvey, BandOfChiSquaredAgreesWithTables) {
  const Interval one = chiSquaredBand(4, 1), many = chiSquaredBand(4, 200);
  EXPECT_NEAR(one.low, 0.484, 0.05);
  EXPECT_NEAR(one.high, 11.143, 0.05);
  EXPECT_NEAR(many.low, 3.62, 0.01);
  EXPECT_NEAR(many.high, 4.40, 0.01);
}

// Drift of position and heading, jitter, and lasting errors of attitude and corners, drawn as the filter
// assumes.
TEST(FilterSurvey, NormalisedErrorOfTwoHundredApproachesLiesInItsBand) {
  double sum = 0.0, end = 0.0;
  int runs = 0;
  for (std::uint32_t seed = 1; seed <= 200; ++seed) {
    auto script = drawApproach(seed, SizeTold::kAll);
    SyntheticApproach approach(seed, script, estimation::FilterParams());
    estimation::TargetEstimator estimator(poseParams(SizeTold::kAll), estimation::FilterParams(), {});
    const auto samples = follow(approach, estimator, script.opening);
    const auto mean = meanNees(samples);
    ASSERT_TRUE(mean) << seed;
    sum += *mean;
    end += samples.back().nees;
    ++runs;
  }
  const Interval band = chiSquaredBand(4, runs);
  std::printf("NEES over %d approaches: %.2f, at their ends %.2f; band %.2f .. %.2f\n", runs, sum / runs,
              end / runs, band.low, band.high);
  EXPECT_GT(sum / runs, band.low);
  EXPECT_LT(sum / runs, band.high);
  EXPECT_GT(end / runs, band.low);
  EXPECT_LT(end / runs, band.high);
}

/// Flies sideways past a window of unknown size, 4 m away.
struct Sideways {
  geometry::OpeningSize opening;
  std::optional<estimation::FilteredWindow> found;
};

Sideways flySideways(std::uint32_t seed, const estimation::FilterParams& errors, double width_m) {
  simulation::RandomStream random(seed, "sideways");
  const double off_axis = random.uniform(-0.5, 0.5), side = seed % 2 == 0 ? 1.0 : -1.0;
  const Eigen::Vector3d from(-4.0 * std::cos(off_axis), 4.0 * std::sin(off_axis), random.uniform(-0.3, 0.3));
  ApproachScript script;
  script.waypoints_m = {from, from + Eigen::Vector3d(0.0, 1.2 * side, 0.0)};
  script.opening = {width_m, random.uniform(0.7, 1.4)};
  SyntheticApproach approach(seed, script, errors);
  estimation::TargetEstimator estimator(poseParams(SizeTold::kNothing), errors, {});
  while (approach.flownM() < 1.0 && approach.advance()) {
    for (const auto& odometry : approach.odometry())
      estimator.addOdometry(odometry.stamp_sec, odometry.T_odom_base);
    if (approach.isInView())
      estimator.addDetection(approach.window(), approach.camera(), approach.T_base_camera());
  }
  return {script.opening, estimator.filtered(approach.timeSec())};
}

// Odometry with a drift of 0.01 m/sqrt(s), like the world's.
estimation::FilterParams worldsOdometry() {
  estimation::FilterParams errors;
  errors.drift_m_per_sqrt_m = 0.005;
  return errors;
}

struct WidthErrors {
  double rms = 0.0, median = 0.0, most = 0.0;  ///< relative; 95 % are below `most`
  double normalised_squares = 0.0;
};

WidthErrors afterAMetreSideways(const estimation::FilterParams& odometry, std::uint32_t first_seed) {
  constexpr int kRuns = 200;
  std::vector<double> errors;
  WidthErrors out;
  for (std::uint32_t seed = first_seed; seed < first_seed + kRuns; ++seed) {
    simulation::RandomStream random(seed, "width");
    const auto [opening, found] = flySideways(seed, odometry, random.uniform(0.7, 1.8));
    EXPECT_TRUE(found) << seed;
    if (!found) continue;
    const double error = std::log(found->size.size.width_m / opening.width_m);
    errors.push_back(std::abs(error));
    out.rms += error * error / kRuns;
    out.normalised_squares += error * error / found->size.log_covariance(0, 0) / kRuns;
  }
  std::sort(errors.begin(), errors.end());
  out.rms = std::sqrt(out.rms);
  out.median = errors[errors.size() / 2];
  out.most = errors[errors.size() * 19 / 20];
  return out;
}

/// Cramer-Rao bound of the scale with such odometry and error-free images: the bearing of a window 4 m away
/// compared with the reported motion. Drift of position and of heading (at the window) is a random walk,
/// jitter is white.
double scaleBound(const estimation::FilterParams& odometry) {
  constexpr double kRateHz = 30.0, kAwayM = 4.0, kWayM = 1.0;
  const double speed_mps = ApproachScript().speed_mps;
  const int images = static_cast<int>(kWayM / speed_mps * kRateHz) + 1;
  const double step_variance =
      (std::pow(odometry.drift_m_per_sqrt_m, 2) * speed_mps + std::pow(odometry.drift_m_per_sqrt_sec, 2) +
       std::pow(kAwayM * odometry.drift_rad_per_sqrt_sec, 2)) /
      kRateHz;
  const double white_variance =
      std::pow(odometry.odom_position_sigma_m, 2) + std::pow(kAwayM * odometry.odom_attitude_sigma_rad, 2);
  Eigen::MatrixXd covariance(images, images), by_scale_and_place(images, 2);
  for (int i = 0; i < images; ++i) {
    by_scale_and_place.row(i) << i * speed_mps / kRateHz, 1.0;
    for (int k = 0; k < images; ++k)
      covariance(i, k) = step_variance * std::min(i, k) + (i == k ? white_variance : 0.0);
  }
  const Eigen::Matrix2d information =
      by_scale_and_place.transpose() * covariance.ldlt().solve(by_scale_and_place);
  return std::sqrt(information.inverse()(0, 0));
}

// The filter's assumed drift of 0.03 m/sqrt(m) alone is 3 % of one metre.
TEST(FilterSurvey, TheWidthAfterAMetreSidewaysIsKnownAsWellAsTheOdometryLets) {
  for (const bool assumed : {false, true}) {
    const estimation::FilterParams odometry = assumed ? estimation::FilterParams() : worldsOdometry();
    const WidthErrors errors = afterAMetreSideways(odometry, 1);
    const double bound = scaleBound(odometry);
    std::printf(
        "width after 1 m sideways: rms %.1f %%, median %.1f %%, 95 %% %.1f %%; bound %.1f %%; normalised "
        "error squared %.2f\n",
        100 * errors.rms, 100 * errors.median, 100 * errors.most, 100 * bound, errors.normalised_squares);
    EXPECT_LT(errors.rms, 1.25 * bound);
    EXPECT_LT(errors.rms, assumed ? 0.05 : 0.03);
    EXPECT_GT(errors.normalised_squares, 0.7);
    EXPECT_LT(errors.normalised_squares, 1.35);
  }
}

TEST(FilterSurvey, TheFitVerdictIsRightWheneverTheTruthIsClear) {
  int clear = 0, right = 0, wrong = 0;
  for (std::uint32_t seed = 1; clear < 200; ++seed) {
    simulation::RandomStream random(seed, "fit");
    const auto [opening, found] =
        flySideways(1000 + seed, estimation::FilterParams(), random.uniform(0.4, 0.8));
    if (!found) continue;
    const double needed = 0.6, width = found->size.size.width_m;
    const double sigma = width * std::sqrt(found->size.log_covariance(0, 0));
    const bool fits = opening.width_m > needed;
    const auto fit = estimation::fitVerdict(found->size, {needed, 0.34}).fit;
    wrong += fit == (fits ? estimation::Fit::kNoGo : estimation::Fit::kGo);
    if (std::abs(width - needed) < 2.0 * sigma) continue;
    ++clear;
    right += fit == (fits ? estimation::Fit::kGo : estimation::Fit::kNoGo);
  }
  std::printf("fit verdict: right in %d of %d clear draws, wrong in %d of all\n", right, clear, wrong);
  EXPECT_EQ(right, clear);
  EXPECT_EQ(wrong, 0);
}

TEST(FilterSurvey, RunsWithoutATrustedSampleHaveNoMean) {
  EXPECT_FALSE(meanNees({}));
  EXPECT_FALSE(meanNees({FilterSample()}));
}

}  // namespace window_ingress::evaluation::filter_survey_test
