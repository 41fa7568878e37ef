#include "navigation/behaviours/position_hold.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "navigation_samples.hpp"

namespace window_ingress::navigation::position_hold_test {

Situation standingAt(const Eigen::Vector3d& position_m, double speed_mps = 0.0) {
  Situation situation;
  situation.vehicle = test::vehicleAt(position_m, 1.0);
  situation.vehicle->velocity_odom_mps.x() = speed_mps;
  return situation;
}

TEST(PositionHold, ThePlaceIsWhereTheVehicleFirstStands) {
  const HoldParams params;
  MissionState mission;
  rememberPlace(true, standingAt({0, 0, 1}, 0.5), params, mission);
  EXPECT_FALSE(mission.place_odom_m) << "still moving";
  rememberPlace(true, standingAt({0.3, 0, 1}), params, mission);
  rememberPlace(true, standingAt({0.9, 0, 1}), params, mission);
  ASSERT_TRUE(mission.place_odom_m);
  EXPECT_EQ(*mission.place_odom_m, Eigen::Vector3d(0.3, 0, 1));
}

TEST(PositionHold, AVehicleThatIsPushedOnGetsAPlaceAllTheSame) {
  const HoldParams params;
  MissionState mission;
  double now = 10.0;
  for (; !mission.place_odom_m && now < 20.0; now += 0.1) {
    auto situation = standingAt({0.5 * (now - 10.0), 0, 1}, 0.5);
    situation.now_sec = now;
    rememberPlace(true, situation, params, mission);
  }
  ASSERT_TRUE(mission.place_odom_m);
  EXPECT_NEAR(now - 10.0, kSettleSec + 0.1, 0.11);
}

TEST(PositionHold, IsBroughtBackByWhatTheVehicleWasCarriedOffByOnce) {
  MissionState mission;
  mission.followVehicle({0, 0, 1}, {9, 0, 0});  // before there is a place
  rememberPlace(true, standingAt({1, 2, 1}), HoldParams(), mission);
  for (int i = 0; i < 3; ++i) mission.followVehicle({0, 0, 1}, {9.5, 0.3, 0});
  EXPECT_LT((*mission.place_odom_m - Eigen::Vector3d(1.5, 2.3, 1)).norm(), 1e-12);
}

TEST(PositionHold, IsForgottenWhenNotWantedAndWithItsOdometry) {
  const HoldParams params;
  MissionState mission;
  const auto set = [&] {
    rememberPlace(true, standingAt({0, 0, 1}), params, mission);
    EXPECT_TRUE(mission.place_odom_m);
  };
  set();
  rememberPlace(false, standingAt({0, 0, 1}), params, mission);
  EXPECT_FALSE(mission.place_odom_m);
  set();
  rememberPlace(true, Situation(), params, mission);
  EXPECT_FALSE(mission.place_odom_m) << "no odometry";
  set();
  auto jumped = standingAt({5, 0, 1});
  jumped.vehicle.reset();
  rememberPlace(true, jumped, params, mission);
  EXPECT_FALSE(mission.place_odom_m);
  set();
  mission.forgetPlaces();
  EXPECT_FALSE(mission.place_odom_m);
}

TEST(PositionHold, LeadsBackNoFasterThanAllowed) {
  const NavigatorParams params = test::withoutGlass();
  MissionState mission;
  EXPECT_EQ(velocityToPlace(test::vehicleAt({1, 2, 3}, 0.0), mission, params), Eigen::Vector3d(0, 0, 0));
  mission.place_odom_m = Eigen::Vector3d(0, 0, 1);
  for (double away = -3.0; away <= 3.0; away += 0.05) {
    const auto velocity = velocityToPlace(test::vehicleAt({away, -0.5 * away, 1}, 0.0), mission, params);
    EXPECT_LE(velocity.norm(), params.hold.speed_mps + 1e-12);
    EXPECT_LE(velocity.x() * away, 0.0);
    EXPECT_GE(velocity.y() * away, 0.0);
  }
  const auto climbed = velocityToPlace(test::vehicleAt({0.2, 0, 4}, 0.0), mission, params);
  EXPECT_NEAR(climbed.x(), -0.2 * params.align.lateral_gain_hz, 1e-12) << "height takes nothing from it";
  EXPECT_NEAR(climbed.z(), -params.hold.speed_mps, 1e-12);
}

// The other window was seen in a wrong place, which is ahead of the vehicle now.
TEST(PositionHold, BehindTheWindowNoOtherWindowKeepsItFromItsPlace) {
  const NavigatorParams params = test::withoutGlass();
  MissionState mission;
  mission.trusted = test::targetAtOrigin(0.0);
  mission.others_odom_m = {Eigen::Vector3d(3.0, 0.0, 1.5)};
  const Eigen::Vector3d ahead(0.3, 0.0, 0.0);
  for (const double side : {-1.0, 1.0}) {
    mission.place_odom_m = Eigen::Vector3d(side * 1.5 + 0.5, 0.0, 1.5);
    const auto velocity =
        onlyToPlace(ahead, test::vehicleAt({side * 1.5, 0.0, 1.5}, 0.0), mission, params.hold);
    EXPECT_NEAR(velocity.x(), side > 0.0 ? 0.3 : 0.0, 1e-12);
  }
}

// The limiter starts from the velocity permitted last. If each step reduced a permitted velocity again,
// nothing of it would be left, and the vehicle would drift past the window to the wall.
TEST(PositionHold, WhatIsPermittedLeadsTowardsNoWindowAndIsPermittedAgain) {
  const NavigatorParams params = test::withoutGlass();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> anywhere(-4.0, 4.0);
  const auto level = [&] {
    const double x = anywhere(random);
    return Eigen::Vector3d(x, anywhere(random), 0.0);
  };
  int moved = 0;
  for (int i = 0; i < 2000; ++i) {
    MissionState mission;
    mission.place_odom_m = level();
    mission.others_odom_m = {level()};
    if (i % 2 == 0) mission.left_odom_m = {level()};
    if (i % 3 == 0) mission.window_odom_m = level();
    const auto vehicle = test::vehicleAt(level(), 0.0);
    const Eigen::Vector3d wish = velocityToPlace(vehicle, mission, params);
    const Eigen::Vector3d once = onlyToPlace(wish, vehicle, mission, params.hold);
    const Eigen::Vector3d twice = onlyToPlace(once, vehicle, mission, params.hold);
    EXPECT_LT((twice - once).norm(), 1e-9);
    EXPECT_GE(once.dot(wish), 0.0);
    moved += once.norm() > 0.05 ? 1 : 0;
    std::vector<Eigen::Vector3d> windows = mission.others_odom_m;
    windows.insert(windows.end(), mission.left_odom_m.begin(), mission.left_odom_m.end());
    if (mission.window_odom_m) windows.push_back(*mission.window_odom_m);
    for (const Eigen::Vector3d& window_odom_m : windows)
      EXPECT_LT(once.dot(window_odom_m - vehicle.T_odom_base.translation()), 1e-6);
  }
  EXPECT_GT(moved, 1000);
}

TEST(PositionHold, DoesNothingWhereItIsSwitchedOff) {
  NavigatorParams params = test::withoutGlass();
  params.hold.speed_mps = 0.0;
  MissionState mission;
  mission.place_odom_m = Eigen::Vector3d(0, 0, 1);
  EXPECT_EQ(velocityToPlace(test::vehicleAt({1, 2, 3}, 0.0), mission, params).norm(), 0.0);
}

}  // namespace window_ingress::navigation::position_hold_test
