#include "adapters/world/world_messages.hpp"

#include <gtest/gtest.h>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters::world_messages_test {

// The vehicle is turned to the left and flies along the odometry frame's x axis, which is to its right.
simulation::OdometrySample flyingToItsRight() {
  simulation::OdometrySample sample;
  sample.T_odom_base = geometry::makePose(geometry::yawRotation(M_PI_2), {1.0, 2.0, 3.0});
  sample.velocity_odom_mps = {0.5, 0.0, 0.1};
  return sample;
}

TEST(WorldMessages, TheTwistOfOdometryStandsInTheBodyFrame) {
  const auto message = toOdometryMsg(flyingToItsRight(), ros::Time(5), FrameNames());
  EXPECT_EQ(message.header.frame_id, "odom");
  EXPECT_EQ(message.child_frame_id, "base_link");
  EXPECT_NEAR(message.twist.twist.linear.x, 0.0, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.y, -0.5, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.z, 0.1, 1e-12);
  const auto back = fromMsg(message, FrameNames());
  ASSERT_TRUE(back) << back.reason;
  EXPECT_TRUE(back.value->velocity_odom_mps.isApprox(flyingToItsRight().velocity_odom_mps, 1e-12));
}

TEST(WorldMessages, TheTwistOfSomeSimulatorsStandsInOdom) {
  const auto message = toOdometryMsg(flyingToItsRight(), ros::Time(5), FrameNames(), true);
  EXPECT_NEAR(message.twist.twist.linear.x, 0.5, 1e-12);
  EXPECT_NEAR(message.twist.twist.linear.y, 0.0, 1e-12);
}

TEST(WorldMessages, TheCamerasMountingIsAChainFromBaseToOptical) {
  const Eigen::Isometry3d T_base_camera =
      geometry::makePose(geometry::R_optical_flu().transpose(), {0.1, 0.0, 0.02});
  const auto chain = mountingOf(T_base_camera, ros::Time(5), FrameNames(), "eye");
  ASSERT_EQ(chain.size(), 2u);
  EXPECT_EQ(chain[0].header.frame_id, "base_link");
  EXPECT_EQ(chain[0].child_frame_id, chain[1].header.frame_id);
  EXPECT_EQ(chain[1].child_frame_id, "eye");
  const Eigen::Isometry3d product = *fromMsg(chain[0].transform).value * *fromMsg(chain[1].transform).value;
  EXPECT_TRUE(product.isApprox(T_base_camera, 1e-12));
}

}  // namespace window_ingress::adapters::world_messages_test
