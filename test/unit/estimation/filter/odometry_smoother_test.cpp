#include "estimation/filter/odometry_smoother.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace window_ingress::estimation::odometry_smoother_test {

const Eigen::Vector3d kVelocity(0.5, -0.2, 0.1);

TEST(OdometrySmoother, FollowsAStraightWayWithoutLag) {
  OdometrySmoother path;
  for (int i = 0; i <= 60; ++i) path.add(i / 30.0, i / 30.0 * kVelocity);
  const auto motion = path.motion();
  ASSERT_TRUE(motion);
  EXPECT_LT((motion->position_m - 2.0 * kVelocity).norm(), 1e-9);
  EXPECT_LT((motion->velocity_mps - kVelocity).norm(), 1e-9);
}

TEST(OdometrySmoother, TakesMostOfTheJitterAway) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(0.0, 0.01);
  double squares = 0.0;
  const int runs = 200;
  for (int run = 0; run < runs; ++run) {
    OdometrySmoother path;
    for (int i = 0; i <= 60; ++i)
      path.add(i / 30.0, i / 30.0 * kVelocity + Eigen::Vector3d(noise(random), noise(random), noise(random)));
    squares += (path.motion()->position_m - 2.0 * kVelocity).squaredNorm() / 3.0 / runs;
  }
  EXPECT_LT(std::sqrt(squares), 0.005);
}

TEST(OdometrySmoother, SaysNothingOfTooLittle) {
  OdometrySmoother path;
  EXPECT_FALSE(path.motion());
  for (int i = 0; i < 4; ++i) path.add(0.2 * i, kVelocity);
  EXPECT_FALSE(path.motion()) << "four samples";
  path.clear();
  for (int i = 0; i < 20; ++i) path.add(0.01 * i, kVelocity);
  EXPECT_FALSE(path.motion()) << "a fifth of a second";
}

TEST(OdometrySmoother, StartsAnewWhenTimeGoesBackAndIgnoresWhatIsNotFinite) {
  OdometrySmoother path;
  for (int i = 0; i <= 30; ++i) path.add(10.0 + i / 30.0, kVelocity);
  path.add(11.1, {0, std::numeric_limits<double>::quiet_NaN(), 0});
  path.add(std::numeric_limits<double>::infinity(), kVelocity);
  ASSERT_TRUE(path.motion());
  EXPECT_LT(path.motion()->velocity_mps.norm(), 1e-9);
  path.add(5.0, kVelocity);
  EXPECT_FALSE(path.motion());
}

}  // namespace window_ingress::estimation::odometry_smoother_test
