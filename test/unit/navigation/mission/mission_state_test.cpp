#include "navigation/mission/mission_state.hpp"

#include <gtest/gtest.h>

namespace window_ingress::navigation::mission_state_test {

TEST(Home, IsWhereTheMissionBeganAndStaysThereWhenTheOdometryJumps) {
  MissionState mission;
  mission.followVehicle({1, 2, 1}, {0, 0, 0});
  mission.followVehicle({4, 6, 1}, {0, 0, 0});
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(1, 2, 1));
  EXPECT_EQ(mission.from_home_m, Eigen::Vector3d(3, 4, 0));
  mission.forgetPlaces();
  EXPECT_EQ(mission.from_home_m, Eigen::Vector3d(3, 4, 0)) << "until odometry comes back";
  mission.followVehicle({104, 6, 1}, {0, 0, 0});
  EXPECT_EQ(*mission.home_odom_m, Eigen::Vector3d(101, 2, 1));
  EXPECT_EQ(mission.from_home_m, Eigen::Vector3d(3, 4, 0));
}

}  // namespace window_ingress::navigation::mission_state_test
