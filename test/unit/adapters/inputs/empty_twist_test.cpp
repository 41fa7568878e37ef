#include "adapters/inputs/empty_twist.hpp"

#include <gtest/gtest.h>

namespace window_ingress::adapters::empty_twist_test {

TEST(EmptyTwist, IsOneWhosePositionMovesWithoutAVelocity) {
  EmptyTwist twist;
  navigation::VehicleState vehicle;
  const auto lookAt = [&](double x_m, double speed_mps) {
    vehicle.T_odom_base.translation() = Eigen::Vector3d(x_m, 0.0, 1.0);
    vehicle.velocity_odom_mps = Eigen::Vector3d(0.0, speed_mps, 0.0);
    return twist.look(vehicle);
  };
  EXPECT_EQ(lookAt(0.0, 0.0), "");
  EXPECT_EQ(lookAt(0.9 * EmptyTwist::kMovedM, 0.0), "") << "a position that is not sure";
  EXPECT_NE(lookAt(1.1 * EmptyTwist::kMovedM, 0.0), "");
  EXPECT_NE(lookAt(0.0, 0.0), "") << "where it has come back to";
  EXPECT_EQ(lookAt(5.0, 1e-6), "") << "a velocity after all";
  EXPECT_EQ(lookAt(9.0, 0.0), "") << "it may have stood since";
  EXPECT_NE(lookAt(9.5, 0.0), "");
}

}  // namespace window_ingress::adapters::empty_twist_test
