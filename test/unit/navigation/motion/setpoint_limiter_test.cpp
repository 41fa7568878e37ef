#include "navigation/motion/setpoint_limiter.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace window_ingress::navigation::setpoint_limiter_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

Setpoint wish(double x, double y, double z, double yaw_rate) { return {Eigen::Vector3d(x, y, z), yaw_rate}; }

bool isZero(const Setpoint& setpoint) {
  return setpoint.velocity_odom_mps == Eigen::Vector3d::Zero() && setpoint.yaw_rate_radps == 0.0;
}

TEST(SetpointLimiter, LetsASlowWishThroughAfterItsRamp) {
  SetpointLimiter limiter{LimitParams()};
  Setpoint out;
  for (int i = 0; i < 100; ++i) out = limiter.limit(wish(0.5, -0.2, 0.1, 0.3), 0.02);
  EXPECT_TRUE(out.velocity_odom_mps.isApprox(Eigen::Vector3d(0.5, -0.2, 0.1)));
  EXPECT_DOUBLE_EQ(out.yaw_rate_radps, 0.3);
}

TEST(SetpointLimiter, KeepsTheDirectionOfAWishThatIsTooFast) {
  SetpointLimiter limiter{LimitParams()};
  Setpoint out;
  for (int i = 0; i < 100; ++i) out = limiter.limit(wish(30.0, 40.0, 0.0, 9.0), 0.1);
  EXPECT_TRUE(out.velocity_odom_mps.isApprox(Eigen::Vector3d(0.6, 0.8, 0.0)));
  EXPECT_DOUBLE_EQ(out.yaw_rate_radps, LimitParams().yaw_rate_radps);
}

TEST(SetpointLimiter, AnythingNotFiniteStopsAtOnce) {
  for (const double bad : {kNan, kInf, -kInf}) {
    for (int where = 0; where < 4; ++where) {
      SetpointLimiter limiter{LimitParams()};
      for (int i = 0; i < 50; ++i) limiter.limit(wish(1, 0, 0, 0.5), 0.05);
      double values[4] = {0.1, 0.1, 0.1, 0.1};
      values[where] = bad;
      EXPECT_TRUE(isZero(limiter.limit(wish(values[0], values[1], values[2], values[3]), 0.02)));
    }
  }
}

TEST(SetpointLimiter, StopIsZeroAtOnceAndTheRampBeginsAnew) {
  SetpointLimiter limiter{LimitParams()};
  for (int i = 0; i < 50; ++i) limiter.limit(wish(1, 0, 0, 0.5), 0.05);
  EXPECT_TRUE(isZero(limiter.stop()));
  const double first = LimitParams().jerk_mps3 * 0.02 * 0.02;
  EXPECT_NEAR(limiter.limit(wish(1, 0, 0, 0), 0.02).velocity_odom_mps.x(), first, 1e-12);
}

TEST(SetpointLimiter, ReachesAWishWithinItsJerkAndWithoutOvershoot) {
  const LimitParams limits;
  for (const double dt : {0.01, 0.033, 0.1}) {
    SetpointLimiter limiter(limits);
    double before = 0.0, acceleration_before = 0.0, time_sec = 0.0;
    while (before < 0.79 && time_sec < 5.0) {
      const double now = limiter.limit(wish(0.8, 0, 0, 0), dt).velocity_odom_mps.x();
      const double acceleration = (now - before) / dt;
      EXPECT_LE(acceleration - acceleration_before, limits.jerk_mps3 * dt + 1e-9);
      EXPECT_LE(now, 0.8 + 0.5 * limits.acceleration_mps2 * dt);
      before = now, acceleration_before = acceleration, time_sec += dt;
    }
    EXPECT_LT(time_sec,
              0.8 / limits.acceleration_mps2 + 2.0 * limits.acceleration_mps2 / limits.jerk_mps3 + 0.2);
  }
}

TEST(SetpointLimiter, CutOnlyTakesAway) {
  SetpointLimiter limiter{LimitParams()};
  for (int i = 0; i < 50; ++i) limiter.limit(wish(0.5, 0, 0, 0.2), 0.05);
  EXPECT_FALSE(isZero(limiter.cutTo(wish(0.2, 0, 0, 0.2))));
  EXPECT_TRUE(isZero(limiter.cutTo(wish(0.9, 0, 0, 0.2))));
  EXPECT_TRUE(isZero(limiter.cutTo(wish(kNan, 0, 0, 0.2))));
}

TEST(SetpointLimiter, BoundsHoldForRandomWishes) {
  std::mt19937 random(7);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  const LimitParams limits;
  SetpointLimiter limiter(limits);
  Setpoint before;
  for (int i = 0; i < 100000; ++i) {
    const double scale = std::pow(10.0, 12.0 * uniform(random) - 6.0);
    auto random_wish =
        wish(scale * gauss(random), scale * gauss(random), scale * gauss(random), scale * gauss(random));
    if (uniform(random) < 0.02) random_wish.velocity_odom_mps.y() = uniform(random) < 0.5 ? kNan : kInf;
    const double dt = uniform(random) < 0.02 ? kNan : 0.4 * uniform(random) - 0.1;
    const Setpoint out = limiter.limit(random_wish, dt);
    const double used = std::isfinite(dt) ? std::min(0.2, std::max(0.0, dt)) : 0.0;
    ASSERT_TRUE(out.velocity_odom_mps.allFinite() && std::isfinite(out.yaw_rate_radps));
    ASSERT_LE(out.velocity_odom_mps.norm(), limits.speed_mps + 1e-9);
    ASSERT_LE(std::abs(out.yaw_rate_radps), limits.yaw_rate_radps + 1e-9);
    if (!isZero(out)) {
      ASSERT_LE((out.velocity_odom_mps - before.velocity_odom_mps).norm(),
                limits.acceleration_mps2 * used + 1e-9);
      ASSERT_LE(std::abs(out.yaw_rate_radps - before.yaw_rate_radps),
                limits.yaw_acceleration_radps2 * used + 1e-9);
    }
    before = out;
  }
}

}  // namespace window_ingress::navigation::setpoint_limiter_test
