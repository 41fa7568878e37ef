/// M61, M66: odometry that turns only in its representation, and invalid setpoints.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/guard/setpoint_gate.hpp"
#include "navigation/motion/setpoint_limiter.hpp"
#include "navigation_samples.hpp"
#include "window_ingress/navigation/navigator.hpp"

namespace window_ingress::adapters::flight_faults_test {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

nav_msgs::Odometry odometry(double stamp_sec, const Eigen::Vector3d& position, double yaw_rad,
                            double factor) {
  nav_msgs::Odometry message;
  message.header.stamp = ros::Time(stamp_sec);
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose.position.x = position.x();
  message.pose.pose.position.y = position.y();
  message.pose.pose.position.z = position.z() + 1e-7 * std::sin(1e3 * stamp_sec);
  message.pose.pose.orientation.z = factor * std::sin(0.5 * yaw_rad);
  message.pose.pose.orientation.w = factor * std::cos(0.5 * yaw_rad);
  return message;
}

std::string refusal(double x, double y, double z, double w) {
  nav_msgs::Odometry message = odometry(10.0, {0, 0, 1.5}, 0.0, 1.0);
  message.pose.pose.orientation.x = x, message.pose.pose.orientation.y = y;
  message.pose.pose.orientation.z = z, message.pose.pose.orientation.w = w;
  return fromMsg(message, FrameNames()).reason;
}

TEST(Fault, M61_QuaternionsThatAreNone) {
  EXPECT_NE(refusal(0, 0, 0, 0).find("length 0.0"), std::string::npos);
  EXPECT_NE(refusal(0, 0, 0, 2).find("length 2.0"), std::string::npos);
  EXPECT_NE(refusal(0, 0, 0, 1e300), "");
  for (const double bad : {kNan, kInf, -kInf})
    for (int i = 0; i < 4; ++i)
      EXPECT_NE(
          refusal(i == 0 ? bad : 0, i == 1 ? bad : 0, i == 2 ? bad : 0, i == 3 ? bad : 1).find("not finite"),
          std::string::npos);
  const auto rounded = fromMsg(odometry(10.0, {0, 0, 1.5}, 0.7, 1.0005), FrameNames());
  ASSERT_TRUE(rounded) << rounded.reason;
  EXPECT_NEAR(rounded.value->T_odom_base.linear().determinant(), 1.0, 1e-12);
}

// The window's axis points along -x of odom, so that the heading towards it lies where the angle wraps.
TEST(Fault, M61_NoSpinWhereTheAngleWraps) {
  navigation::Navigator navigator{test::withoutGlass()};
  double fastest = 0.0, now = 10.0, yaw = M_PI;
  Eigen::Vector3d position(4.0, 0.0, 1.5), velocity(0.0, 0.0, 0.0);
  for (int i = 0; i < 300; ++i, now += 0.033) {
    const double sign = i % 3 == 0 ? -1.0 : 1.0,
                 jitter = i % 2 ? 1e-3 : -1e-3;  // the sign flips, and the angle wraps
    const auto vehicle = fromMsg(odometry(now, position, yaw + jitter, sign), FrameNames());
    ASSERT_TRUE(vehicle) << vehicle.reason;
    navigation::NavigatorInput input = test::inputAt(position, now);
    input.vehicle = vehicle.value;
    input.vehicle->velocity_odom_mps = velocity;
    input.target->T_odom_window.linear() = geometry::yawRotation(i % 2 ? M_PI : -M_PI + 1e-9);
    if (i == 0) {
      EXPECT_TRUE(navigator.start(input, now).success);
    }
    const auto output = navigator.step(input, now);
    fastest = std::max(fastest, std::abs(output.setpoint.yaw_rate_radps));
    velocity = output.setpoint.velocity_odom_mps;
    position += 0.033 * velocity;
    yaw += 0.033 * output.setpoint.yaw_rate_radps;
    if (navigation::isEnd(output.state)) break;
  }
  EXPECT_LT(fastest, 0.02);
  EXPECT_LT(position.x(), 3.0) << "it has flown on meanwhile";
  RecordProperty("seen", "refused or normalised; heading at +-pi with flipping signs: at most " +
                             std::to_string(fastest) + " rad/s");
}

geometry_msgs::Twist mutated(int field, double value) {
  geometry_msgs::Twist twist;
  twist.linear.x = 0.4;
  twist.angular.z = 0.1;
  double* const fields[] = {&twist.linear.x,  &twist.linear.y,  &twist.linear.z,
                            &twist.angular.x, &twist.angular.y, &twist.angular.z};
  *fields[field] = value;
  return twist;
}

bool isZero(const geometry_msgs::Twist& t) {
  return t.linear.x == 0 && t.linear.y == 0 && t.linear.z == 0 && t.angular.x == 0 && t.angular.y == 0 &&
         t.angular.z == 0;
}

// Each number of the setpoint is made invalid, before and after the limiter.
TEST(Fault, M66_SetpointsThatAreNone) {
  const GuardParams params;
  SetpointGate gate(params);
  gate.receive(mutated(0, 0.4), 0.0);
  EXPECT_EQ(gate.fault(), "");
  EXPECT_EQ(gate.output(0.0)->linear.x, 0.4);
  std::string fault;
  for (const double bad : {kNan, -kNan, kInf, -kInf, 1e300, 50.0}) {
    for (int field = 0; field < 6; ++field) {
      gate.receive(mutated(field, bad), 0.0);
      EXPECT_TRUE(isZero(*gate.output(0.0))) << field << " " << bad;
      EXPECT_NE(gate.fault(), "") << field << " " << bad;
      if (std::isnan(bad)) fault = gate.fault();
    }
    for (int field = 0; field < 4 && !(std::abs(bad) < kInf); ++field) {
      navigation::SetpointLimiter limiter{navigation::LimitParams()};
      for (int i = 0; i < 50; ++i) limiter.limit({{0.4, 0.0, 0.0}, 0.1}, 0.05);
      navigation::Setpoint wish{{0.4, 0.0, 0.0}, 0.1};
      (field < 3 ? wish.velocity_odom_mps(field) : wish.yaw_rate_radps) = bad;
      const navigation::Setpoint output = limiter.limit(wish, 0.033);
      EXPECT_EQ(output.velocity_odom_mps.norm() + std::abs(output.yaw_rate_radps), 0.0);
    }
  }
  RecordProperty("seen", "zero, and the diagnostics' ERROR says: " + fault);
}

}  // namespace window_ingress::adapters::flight_faults_test
