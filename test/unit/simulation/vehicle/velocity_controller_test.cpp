#include "simulation/vehicle/velocity_controller.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace window_ingress::simulation::velocity_controller_test {

constexpr double kStep_sec = 0.0025;
const Eigen::Vector3d kStill = Eigen::Vector3d::Zero();

// Only the feed-forward term: the acceleration of the shaped setpoint.
QuadrotorParams shapingOnly() {
  QuadrotorParams params;
  params.acceleration_feed_forward = 1.0;
  params.velocity_integral_per_sec = 0.0;
  params.velocity_time_constant_sec = 3.0;
  return params;
}

TEST(VelocityController, WithoutShapingItIsAProportionalControllerUpToItsLimit) {
  QuadrotorParams params;
  params.velocity_integral_per_sec = 0.0;
  VelocityController controller(params);
  EXPECT_TRUE(controller.step({0.4, 0, -0.2}, kStill, kStep_sec).isApprox(Eigen::Vector3d(1.0, 0, -0.5)));
  EXPECT_NEAR(controller.step({5, 0, 0}, kStill, kStep_sec).norm(), params.max_acceleration_mps2, 1e-12);
}

TEST(VelocityController, TheSetpointsAccelerationAndItsChangeKeepTheirLimits) {
  QuadrotorParams params = shapingOnly();
  params.setpoint_acceleration_mps2 = 1.5;
  params.setpoint_time_constant_sec = 0.5;
  params.setpoint_jerk_mps3 = 6.0;
  VelocityController controller(params);
  Eigen::Vector3d velocity = kStill, last = kStill;
  double most = 0.0, most_change = 0.0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d wanted(i < 2000 ? 2.0 : -1.0, i < 2000 ? 0.0 : 2.0, 0.0);
    const Eigen::Vector3d acceleration = controller.step(wanted, velocity, kStep_sec);
    velocity += kStep_sec * acceleration;
    most = std::max(most, acceleration.norm());
    most_change = std::max(most_change, (acceleration - last).norm() / kStep_sec);
    last = acceleration;
  }
  EXPECT_NEAR(most, 1.5, 0.02);
  EXPECT_NEAR(most_change, 6.0, 0.1);
  EXPECT_TRUE(velocity.isApprox(Eigen::Vector3d(-1.0, 2.0, 0.0), 1e-3));
}

TEST(VelocityController, HoldPullsItToWhereTheSetpointLed) {
  for (const double hold_per_sec : {0.0, 1.0}) {
    QuadrotorParams params;
    params.velocity_integral_per_sec = 0.0;
    params.position_hold_per_sec = hold_per_sec;
    VelocityController controller(params);
    Eigen::Vector3d velocity = kStill;
    double travelled_m = 0.0;
    for (int i = 0; i < 6000; ++i) {
      const Eigen::Vector3d wanted(i < 400 ? 0.5 : 0.0, 0, 0);
      velocity += kStep_sec * (controller.step(wanted, velocity, kStep_sec) - Eigen::Vector3d(0.2, 0, 0));
      travelled_m += kStep_sec * velocity.x();
    }
    if (hold_per_sec > 0.0) {
      EXPECT_NEAR(travelled_m, 0.5 - 0.2 * params.velocity_time_constant_sec, 0.01)
          << "stays, against a push";
    } else {
      EXPECT_LT(travelled_m, -0.5) << "is carried away";
    }
  }
}

TEST(VelocityController, TheTrimLearnsNearTheSetpointAndIsHardlyWoundUpByAStep) {
  const QuadrotorParams params;
  const double rate = params.velocity_integral_per_sec / params.velocity_time_constant_sec;
  VelocityController controller(params);
  controller.setTrim({0, 0, 1.0});
  for (int i = 0; i < 400; ++i) controller.step({3.0, 0, 0}, kStill, kStep_sec);
  EXPECT_EQ(controller.trim(), Eigen::Vector3d(0, 0, 1.0)) << "at the limit: not at all";
  for (int i = 0; i < 400; ++i) controller.step({0.1, 0, 0}, kStill, kStep_sec);
  EXPECT_NEAR(controller.trim().x(), 0.1 * rate, 1e-9);
  for (int i = 0; i < 400; ++i) controller.step({0, 0.9, 0}, kStill, kStep_sec);
  EXPECT_NEAR(controller.trim().y(), 0.1 * rate, 1e-9) << "a ninth of the error counts";
  controller.restart();
  EXPECT_EQ(controller.trim().z(), 1.0) << "a restart keeps it";
}

TEST(VelocityController, NoPushIsTooStrongToBeLearntAway) {
  VelocityController controller{QuadrotorParams()};
  Eigen::Vector3d velocity = kStill;
  for (int i = 0; i < 8000; ++i)
    velocity += kStep_sec * (controller.step(kStill, velocity, kStep_sec) + Eigen::Vector3d(0, 2.0, 0));
  EXPECT_LT(velocity.norm(), 0.01);
}

}  // namespace window_ingress::simulation::velocity_controller_test
