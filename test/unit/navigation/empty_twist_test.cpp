#include "window_ingress/navigation/empty_twist.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

namespace window_ingress::navigation::empty_twist_test {

TEST(EmptyTwist, IsOneWhosePositionMovesWithoutAVelocity) {
  EmptyTwist twist;
  VehicleState vehicle;
  vehicle.T_odom_base.linear() = Eigen::AngleAxisd(0.2, Eigen::Vector3d::UnitY()).toRotationMatrix();
  const auto lookAt = [&](double stamp_sec, double x_m, double speed_mps) {
    vehicle.stamp_sec = stamp_sec;
    vehicle.T_odom_base.translation() = Eigen::Vector3d(x_m, 0.0, 1.0);
    // The velocity along the body's vertical axis is there.
    vehicle.velocity_odom_mps = vehicle.T_odom_base.linear() * Eigen::Vector3d(0.0, speed_mps, 0.4);
    return twist.look(vehicle);
  };
  EXPECT_EQ(lookAt(0.0, 0.0, 0.0), "");
  EXPECT_EQ(lookAt(0.2, 0.15, 0.0), "");
  EXPECT_EQ(lookAt(0.4, 0.29, 0.0), "") << "a position that is not sure";
  EXPECT_NE(lookAt(0.6, 0.31, 0.0), "");
  EXPECT_NE(lookAt(9.0, 0.0, 0.0), "") << "where it has come back to";
  EXPECT_EQ(lookAt(9.1, 5.0, 1e-3), "") << "a velocity after all";
  EXPECT_EQ(lookAt(9.2, 9.0, 0.0), "") << "a jump";
  EXPECT_EQ(lookAt(9.4, 9.19, 0.0), "");
  EXPECT_NE(lookAt(9.6, 9.38, 0.0), "");
}

TEST(EmptyTwist, IsNoneOfAVehicleThatStandsAndWhosePositionSlides) {
  EmptyTwist twist;
  VehicleState vehicle;
  for (int i = 0; i < 150; ++i) {
    vehicle.stamp_sec = i / 50.0;
    vehicle.T_odom_base.translation().x() = 2.0 * vehicle.stamp_sec;
    vehicle.velocity_odom_mps.y() = i % 2 == 0 ? 1e-3 : -1e-3;
    EXPECT_EQ(twist.look(vehicle), "");
  }
}

TEST(EmptyTwist, IsNoneWhereThePositionMovesNoFasterThanItMayWander) {
  EmptyTwist twist;
  VehicleState vehicle;
  for (int i = 0; i < 3000; ++i) {
    vehicle.stamp_sec = i / 50.0;
    vehicle.T_odom_base.translation().x() = 0.09 * vehicle.stamp_sec;
    EXPECT_EQ(twist.look(vehicle), "");
  }
}

}  // namespace window_ingress::navigation::empty_twist_test
