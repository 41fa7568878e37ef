#include "estimation/checks/parallax_check.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <random>

namespace window_ingress::estimation::parallax_check_test {

struct Seen {
  ParallaxCheck check;
  double way_m = 0.0;  ///< path length until the verdict
};

/// Moves across the line of sight to a window, with noise. `factor` is its true size over its stated size.
Seen moveBy(double way_m, double factor, double distance_m, unsigned seed, const Eigen::Vector3d& direction,
            double drift_m_per_sqrt_sec = 0.0) {
  std::mt19937 random(seed);
  std::normal_distribution<double> gauss;
  const Eigen::Vector3d window(distance_m, 0.3, 0.2);
  Seen seen;
  seen.check.assumeDrift(drift_m_per_sqrt_sec);
  for (double moved = 0.0; moved <= way_m; moved += 0.02) {
    const Eigen::Vector3d camera = moved * direction.normalized();
    const Eigen::Vector3d noise(gauss(random), gauss(random), gauss(random));
    const Eigen::Vector3d sight = window + (0.01 + 0.004 * distance_m) * noise - camera;
    if (!seen.check.otherFactor()) seen.way_m = moved;
    seen.check.see(2.0 * moved, camera, camera + sight / factor);  // 0.5 m/s
  }
  return seen;
}

TEST(ParallaxCheck, NamesAWindowOfAnotherSizeAfterHalfAMetre) {
  for (unsigned seed = 1; seed <= 100; ++seed)
    for (const double factor : {0.4, 0.5}) {
      const Seen seen = moveBy(1.0, factor, 5.0 * factor, seed, {0, 1, 0});
      ASSERT_TRUE(seen.check.otherFactor()) << factor;
      EXPECT_LT(seen.way_m, 0.8) << factor;
      EXPECT_NEAR(*seen.check.otherFactor(), factor, 0.25 * factor);
    }
}

// As assumed until the drift is measured.
TEST(ParallaxCheck, NamesItWithinAMetreUnderASatelliteReceiversDrift) {
  for (unsigned seed = 1; seed <= 100; ++seed)
    for (const double factor : {0.4, 0.5}) {
      const Seen seen = moveBy(1.5, factor, 5.0 * factor, seed, {0, 1, 0}, 0.05);
      ASSERT_TRUE(seen.check.otherFactor()) << factor;
      EXPECT_LT(seen.way_m, 1.0) << factor;
    }
}

TEST(ParallaxCheck, TakesItBackWhereTheSizeIsCertainlyAsSaid) {
  Seen seen = moveBy(1.0, 0.5, 2.5, 1, {0, 1, 0});
  ASSERT_TRUE(seen.check.otherFactor());
  for (int i = 0; i < 120; ++i) seen.check.see(3.0 + i / 30.0, {0, 1.0 + 0.02 * i, 0}, {2.5, 0.3, 0.2});
  EXPECT_FALSE(seen.check.otherFactor());
}

TEST(ParallaxCheck, NeverNamesOneOfTheSizeSaid) {
  for (unsigned seed = 1; seed <= 500; ++seed)
    for (const double distance_m : {2.0, 5.0, 9.0}) {
      const Seen seen = moveBy(0.6, 1.0, distance_m, seed, {0.3, 1, 0.5});
      EXPECT_FALSE(seen.check.otherFactor()) << distance_m;
    }
}

// The vehicle hovers, and only its position walks: the window, as computed, moves with it.
TEST(ParallaxCheck, APositionThatWalksAsToldIsNoOtherWindow) {
  int untold = 0, told = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> step(0.0, 0.08 * std::sqrt(1.0 / 30.0));
    ParallaxCheck strict, check;
    check.assumeDrift(0.08);
    Eigen::Vector3d walk(0, 0, 0);
    for (int i = 0; i < 30 * 20; ++i) {
      walk += Eigen::Vector3d(step(random), step(random), 0.0);
      strict.see(i / 30.0, walk, walk + Eigen::Vector3d(2.0, 0.0, 0.0));
      check.see(i / 30.0, walk, walk + Eigen::Vector3d(2.0, 0.0, 0.0));
    }
    untold += strict.otherFactor().has_value();
    told += check.otherFactor().has_value();
  }
  EXPECT_GT(untold, 20);
  EXPECT_EQ(told, 0);
}

TEST(ParallaxCheck, OdometryATenthOfASecondLateIsNoOtherWindow) {
  for (const double late_sec : {-0.1, 0.1})
    for (const double distance_m : {3.0, 5.0, 8.0}) {
      ParallaxCheck check;
      const Eigen::Vector3d window(distance_m, 0.0, 0.0);
      const auto yAt = [](double t) {
        return t < 0.0 ? 0.0 : t < 0.6 ? 0.75 * t * t : 0.27 + 0.9 * (t - 0.6);
      };
      for (double t = 0.0; t < 2.0; t += 0.033) {
        const Eigen::Vector3d camera(0.0, yAt(t), 0.0), told(0.0, yAt(t - late_sec), 0.0);
        // The camera keeps pointing at the window. Heading and position are equally late.
        const auto bearing = [&](double y) { return std::atan2(-y, distance_m); };
        const double turn = bearing(told.y()) - bearing(camera.y());
        const Eigen::AngleAxisd turned(turn, Eigen::Vector3d::UnitZ());
        check.see(t, told, told + turned * (window - camera));
        EXPECT_FALSE(check.otherFactor()) << late_sec << " " << distance_m << " " << t;
      }
    }
}

TEST(ParallaxCheck, StaysOpenWithoutMotionAcrossTheSight) {
  EXPECT_FALSE(moveBy(0.0, 0.5, 5.0, 1, {0, 1, 0}).check.otherFactor());
  EXPECT_FALSE(moveBy(1.0, 0.5, 5.0, 1, {5.0, 0.3, 0.2}).check.otherFactor());
  ParallaxCheck still;
  for (int i = 0; i < 100; ++i) still.see(0.03 * i, {0, 0, 0}, {5, 0.01 * i, 0});
  EXPECT_FALSE(still.otherFactor());
}

TEST(ParallaxCheck, ForgetsAndIgnoresWhatIsNoNumber) {
  Seen seen = moveBy(0.8, 0.5, 5.0, 1, {0, 1, 0});
  seen.check.clear();
  EXPECT_FALSE(seen.check.otherFactor());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (int i = 0; i < 50; ++i) {
    seen.check.see(0.03 * i, {0, nan, 0.1 * i}, {5, 0, 0});
    seen.check.see(0.03 * i, {0, 0, 0.1 * i}, {nan, 0, 0});
    seen.check.see(nan, {0, 0, 0.1 * i}, {5, 0, 0});
    seen.check.see(-0.03 * i, {0, 0, 0.1 * i}, {5, 0, 0});
  }
  EXPECT_FALSE(seen.check.otherFactor());
}

}  // namespace window_ingress::estimation::parallax_check_test
