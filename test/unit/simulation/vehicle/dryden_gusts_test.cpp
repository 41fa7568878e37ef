#include "simulation/vehicle/dryden_gusts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>
#include <vector>

namespace window_ingress::simulation::dryden_gusts_test {

constexpr double kAirspeed_mps = 5.0;
constexpr int kAlong = 0, kAcross = 1, kUp = 2;

using Series = std::vector<double>;

std::vector<Series> gusts(double step_sec, std::size_t count, std::uint32_t seed = 1) {
  DrydenGusts model(seed);
  const DrydenScale scale = drydenScale(6.0, 8.0);
  std::vector<Series> axes(3, Series(count));
  for (std::size_t i = 0; i < count; ++i) {
    const Eigen::Vector3d gust = model.step(step_sec, scale, kAirspeed_mps);
    for (std::size_t axis = 0; axis < 3; ++axis) axes[axis][i] = gust[static_cast<int>(axis)];
  }
  return axes;
}

double correlation(const Series& x, std::size_t lag) {
  double sum = 0.0;
  for (std::size_t i = 0; i + lag < x.size(); ++i) sum += x[i] * x[i + lag];
  return sum / static_cast<double>(x.size() - lag);
}

// One-sided spectrum over w, as in MIL-F-8785C.
double standardDensity(int axis, double w) {
  const DrydenScale scale = drydenScale(6.0, 8.0);
  const double T = scale.length_m[axis] / kAirspeed_mps, variance = std::pow(scale.sigma_mps[axis], 2);
  const double x = std::pow(T * w, 2);
  if (axis == kAlong) return variance * 2.0 * T / M_PI / (1.0 + x);
  return variance * T / M_PI * (1.0 + 3.0 * x) / std::pow(1.0 + x, 2);
}

// Welch's method: Hann windows with half overlap. Element k belongs to w = 2 pi k / (segment * step);
// one-sided.
Series welch(const Series& x, std::size_t segment, double step_sec) {
  Series window(segment), density(segment / 2, 0.0);
  double power = 0.0;
  for (std::size_t i = 0; i < segment; ++i) {
    window[i] = 0.5 - 0.5 * std::cos(2.0 * M_PI * static_cast<double>(i) / static_cast<double>(segment));
    power += window[i] * window[i];
  }
  int segments = 0;
  cv::Mat piece(1, static_cast<int>(segment), CV_64F), spectrum;
  for (std::size_t start = 0; start + segment <= x.size(); start += segment / 2, ++segments) {
    for (std::size_t i = 0; i < segment; ++i)
      piece.at<double>(static_cast<int>(i)) = window[i] * x[start + i];
    cv::dft(piece, spectrum, cv::DFT_COMPLEX_OUTPUT);
    for (std::size_t k = 0; k < density.size(); ++k) {
      const auto value = spectrum.at<cv::Vec2d>(static_cast<int>(k));
      density[k] += value.dot(value);
    }
  }
  for (double& d : density) d *= step_sec / (M_PI * power * segments);
  return density;
}

TEST(DrydenGusts, SpectraAreThoseOfTheStandardInEveryBand) {
  const double step_sec = 0.02;
  const std::size_t segment = 8192;
  const auto axes = gusts(step_sec, 1u << 20);
  for (const int axis : {kAlong, kAcross, kUp}) {
    const Series density = welch(axes[static_cast<std::size_t>(axis)], segment, step_sec);
    const double resolution = 2.0 * M_PI / (static_cast<double>(segment) * step_sec);
    for (double low = 0.15; low < 30.0; low *= 2.0) {  // octaves, from below the corner to far above
      double found = 0.0, wanted = 0.0;
      for (auto k = static_cast<std::size_t>(low / resolution);
           static_cast<double>(k) * resolution < 2.0 * low; ++k) {
        found += density[k];
        wanted += standardDensity(axis, static_cast<double>(k) * resolution);
      }
      EXPECT_NEAR(found / wanted, 1.0, 0.12) << "axis " << axis << " from " << low << " rad/s";
    }
  }
}

TEST(DrydenGusts, VarianceAndCorrelationDoNotDependOnTheStep) {
  const DrydenScale scale = drydenScale(6.0, 8.0);
  for (const double step_sec : {0.0125, 0.05, 0.25}) {
    const auto axes = gusts(step_sec, static_cast<std::size_t>(20000.0 / step_sec), 3);
    for (const int axis : {kAlong, kAcross, kUp}) {
      const Series& x = axes[static_cast<std::size_t>(axis)];
      const double variance = std::pow(scale.sigma_mps[axis], 2);
      EXPECT_NEAR(correlation(x, 0), variance, 0.08 * variance) << axis << " step " << step_sec;
      const double lag = 0.5 * kAirspeed_mps / scale.length_m[axis];
      const double expected = std::exp(-lag) * (axis == kAlong ? 1.0 : 1.0 - 0.5 * lag);
      EXPECT_NEAR(correlation(x, static_cast<std::size_t>(std::lround(0.5 / step_sec))), expected * variance,
                  0.08 * variance)
          << axis << " step " << step_sec;
    }
  }
}

TEST(DrydenGusts, BeginInTheMiddleOfItAndTheSeedDecides) {
  Series first(2000);
  const DrydenScale scale = drydenScale(6.0, 8.0);
  for (std::uint32_t seed = 0; seed < first.size(); ++seed)
    first[seed] = DrydenGusts(seed).step(1e-9, scale, kAirspeed_mps)[kUp];
  EXPECT_NEAR(correlation(first, 0), std::pow(scale.sigma_mps.z(), 2),
              0.1 * std::pow(scale.sigma_mps.z(), 2));
  EXPECT_EQ(gusts(0.0025, 100, 5), gusts(0.0025, 100, 5));
  EXPECT_NE(gusts(0.0025, 100, 5), gusts(0.0025, 100, 6));
}

TEST(DrydenGusts, ScalesAreThoseOfTheStandard) {
  // 100 feet, 30 knots at 20 feet: h / (0.177 + 0.0823)^1.2 = 505.3 feet; 0.1 W20 = 3 knots.
  const double foot_m = 0.3048, knot_mps = 0.514444;
  const DrydenScale scale = drydenScale(100.0 * foot_m, 30.0 * knot_mps);
  EXPECT_NEAR(scale.length_m.x() / foot_m, 505.3, 0.5);
  EXPECT_DOUBLE_EQ(scale.length_m.x(), scale.length_m.y());
  EXPECT_NEAR(scale.length_m.z() / foot_m, 100.0, 1e-9);
  EXPECT_NEAR(scale.sigma_mps.z() / knot_mps, 3.0, 1e-9);
  EXPECT_NEAR(scale.sigma_mps.x() / knot_mps, 3.0 / std::pow(0.2593, 0.4), 1e-9);
  EXPECT_EQ(drydenScale(0.5, 5.0).length_m, drydenScale(10.0 * foot_m, 5.0).length_m) << "begins at 10 feet";
  EXPECT_NEAR(windAtHeight(20.0 * foot_m, 7.0), 7.0, 1e-12);
  EXPECT_LT(windAtHeight(1.5, 7.0), 5.5);
  EXPECT_GT(windAtHeight(0.0, 7.0), 0.0);
}

TEST(DrydenGusts, StayFiniteInStillAirAndOverLongSteps) {
  DrydenGusts model(1);
  for (const double step_sec : {1e-6, 0.0025, 100.0, 1e9})
    for (const double airspeed_mps : {0.0, 1e-9, 50.0})
      EXPECT_TRUE(model.step(step_sec, drydenScale(1.0, 10.0), airspeed_mps).allFinite());
}

}  // namespace window_ingress::simulation::dryden_gusts_test
