#include "simulation/vehicle/wind.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace window_ingress::simulation::wind_test {

constexpr double kStep_sec = 0.0025, kHalfLength_m = 0.2;
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

WallInAir wall() {
  WallInAir wall;
  wall.opening = {1.2, 1.0};
  return wall;
}

Wind windOf(const WindParams& params, const WallInAir& around = wall(), std::uint32_t seed = 1) {
  return Wind(params, around, kHalfLength_m, seed);
}

TEST(Wind, BlowsOutsideAndHardlyInTheRoom) {
  WindParams params;
  params.x_mps = 2.0;
  params.y_mps = -1.0;
  Wind wind = windOf(params);
  EXPECT_EQ(wind.step(kStep_sec, {-3, 0, 0}, kStill).wind_mps, Eigen::Vector3d(2, -1, 0));
  EXPECT_TRUE(wind.steadyAt({1.5, 0, 0}).isApprox(0.1 * Eigen::Vector3d(2, -1, 0)));
  double last = 3.0;
  for (double x_m = -1.0; x_m < 2.0; x_m += 0.01) {
    const double now = wind.steadyAt({x_m, 0, 0}).norm();
    EXPECT_LE(now, last + 1e-12);
    EXPECT_LT(last - now, x_m > -0.99 ? 0.1 : 3.0) << "no jump at " << x_m;
    last = now;
  }
}

TEST(Wind, GustsHaveTheStandardsSizeOutsideAndLittleInside) {
  WindParams params;
  params.gusts = "dryden";
  params.wind_20ft_mps = 6.0;
  params.y_mps = 3.0;  // along the window's y now
  double outside[3] = {0, 0, 0}, inside = 0.0;
  const int count = 4000;
  const double step_sec = 2.0;
  Wind wind = windOf(params), in_room = windOf(params);
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d gust =
        wind.step(step_sec, {-3, 0, 1.0}, kStill).wind_mps - Eigen::Vector3d(0, 3, 0);
    for (int axis = 0; axis < 3; ++axis) outside[axis] += gust[axis] * gust[axis] / count;
    inside += std::pow(in_room.step(step_sec, {2, 0, 1.0}, kStill).wind_mps.z(), 2) / count;
  }
  const DrydenScale scale = drydenScale(2.5, 6.0);
  for (int axis = 0; axis < 3; ++axis)
    EXPECT_NEAR(std::sqrt(outside[axis]), scale.sigma_mps[axis], 0.08 * scale.sigma_mps[axis]) << axis;
  EXPECT_NEAR(std::sqrt(inside), 0.1 * scale.sigma_mps.z(), 0.01 * scale.sigma_mps.z());
}

TEST(Wind, IsStillByDefaultAndWithGustsOfNoWind) {
  WindParams params;
  EXPECT_EQ(windOf(params).step(kStep_sec, {-1, 0, 0}, kStill).wind_mps, kStill);
  EXPECT_EQ(windOf(params).step(kStep_sec, {-0.3, 1.5, 0}, kStill).push_mps2, kStill);
  params.gusts = "dryden";
  params.wind_20ft_mps = 0.0;
  EXPECT_EQ(windOf(params).step(kStep_sec, {-1, 0, 0}, kStill).wind_mps, kStill);
}

TEST(Wind, DraughtFillsTheOpeningAndDiesAwayBeforeAndBehind) {
  for (const double speed_mps : {2.0, -2.0}) {
    WindParams params;
    params.draught_mps = speed_mps;
    const Wind wind = windOf(params);
    const double into = speed_mps > 0.0 ? 1.0 : -1.0, far_m = speed_mps > 0.0 ? -1.0 : 1.24;
    EXPECT_NEAR(wind.steadyAt({0.12, 0, 0}).x(), speed_mps, 1e-3);
    EXPECT_NEAR(wind.steadyAt({0.12, 0.6, 0}).x(), 0.5 * speed_mps, 1e-3) << "half at the border";
    EXPECT_NEAR(wind.steadyAt({0.12, 0.9, 0}).x(), 0.0, 1e-3);
    EXPECT_NEAR(wind.steadyAt({far_m, 0, 0}).x(), speed_mps * 1.2 / (1.2 + 10.0), 1e-6)
        << "DallaValle, 1 m upstream";
    EXPECT_LT(wind.steadyAt({far_m, 1.5, 0}).y(), 0.0) << "drawn towards the opening";
    EXPECT_GT(into * wind.steadyAt({0.12 + into * 2.0, 0, 0}).x(), 1.7) << "the jet's core";
    const double wide = wind.steadyAt({0.12 + into * 4.0, 0.7, 0}).x();
    EXPECT_GT(into * wide, 0.2) << "a jet widens";
    EXPECT_NEAR(wind.steadyAt({0.12 + into * 20.0, 0, 0}).x() / wind.steadyAt({0.12 + into * 40.0, 0, 0}).x(),
                2.0, 0.7);
  }
}

TEST(Wind, DraughtIsContinuousAlongTheAxis) {
  WindParams params;
  params.draught_mps = 3.0;
  const Wind wind = windOf(params);
  for (double x_m = -5.0; x_m < 8.0; x_m += 0.005)
    EXPECT_LT((wind.steadyAt({x_m + 0.005, 0.1, 0.1}) - wind.steadyAt({x_m, 0.1, 0.1})).norm(), 0.2) << x_m;
}

TEST(Wind, ThereIsNoDraughtThroughAClosedWall) {
  WindParams params;
  params.draught_mps = 3.0;
  WallInAir closed = wall();
  closed.open = false;
  EXPECT_EQ(windOf(params, closed).steadyAt({-0.5, 0, 0}), kStill);
}

TEST(Wind, TheWallDrawsWhoIsNearItFromEitherSideButNotInFrontOfTheOpening) {
  WindParams params;
  params.wall_push_mps2 = 0.8;
  params.wall_push_length_m = 0.4;
  Wind wind = windOf(params);
  const auto push = [&](double x_m, double y_m) {
    return wind.step(kStep_sec, {x_m, y_m, 0}, kStill).push_mps2.x();
  };
  EXPECT_NEAR(push(-kHalfLength_m, 1.5), 0.8, 1e-6) << "touching";
  EXPECT_NEAR(push(-kHalfLength_m - 0.4, 1.5), 0.8 * std::exp(-1.0), 1e-6);
  EXPECT_LT(push(-3.0, 1.5), 1e-3);
  EXPECT_NEAR(push(0.24 + kHalfLength_m, 1.5), -0.8, 1e-6) << "from the room";
  EXPECT_NEAR(push(-0.3, 0.0), 0.0, 1e-3) << "there is no wall in the opening";
  EXPECT_EQ(push(-0.3, 7.0), 0.0) << "beside the house";
}

}  // namespace window_ingress::simulation::wind_test
