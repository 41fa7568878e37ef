#include "navigation/behaviours/home.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "navigation/mission/mission_clock.hpp"
#include "navigation_samples.hpp"

namespace window_ingress::navigation::home_test {

TEST(Home, IsWhereTheMissionBeganAndStaysThereWhenTheOdometryJumps) {
  Home home;
  MissionState mission;
  home.follow(test::vehicleAt({1, 2, 1}, 0.0), mission);
  home.follow(test::vehicleAt({4, 6, 1}, 1.0), mission);
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(1, 2, 1));
  EXPECT_DOUBLE_EQ(home.awayM(), 5.0);
  home.odometryJumped();
  home.follow(test::vehicleAt({104, 6, 1}, 2.0), mission);
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(101, 2, 1));
  EXPECT_DOUBLE_EQ(home.awayM(), 5.0);
}

TEST(Home, ANewMissionHasANewHome) {
  Home home;
  MissionState mission;
  home.follow(test::vehicleAt({1, 2, 1}, 0.0), mission);
  home.follow(test::vehicleAt({4, 6, 1}, 1.0), mission);
  mission = MissionState();
  home.follow(test::vehicleAt({4, 6, 1}, 2.0), mission);
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(4, 6, 1));
  EXPECT_EQ(home.awayM(), 0.0);
}

TEST(MissionClock, CountsTimeButNoJumps) {
  MissionClock clock;
  clock.startMission(100.0);
  clock.enterState();
  for (int i = 1; i <= 10; ++i) clock.pass(100.0 + 0.1 * i);
  clock.enterState();
  clock.pass(101.5);
  EXPECT_NEAR(clock.inMissionSec(), 1.5, 1e-9);
  EXPECT_NEAR(clock.inStateSec(), 0.5, 1e-9);
  clock.pass(201.5);  // one second of it may be true
  EXPECT_NEAR(clock.inMissionSec(), 2.5, 1e-9);
  clock.pass(50.0);
  EXPECT_NEAR(clock.inMissionSec(), 2.5, 1e-9);
  clock.pass(std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(clock.nowSec(), 50.0);
}

}  // namespace window_ingress::navigation::home_test
