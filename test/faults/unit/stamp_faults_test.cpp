/// M37, M39: invalid stamps in every stamped message.
#include <gtest/gtest.h>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/inputs/stamp_gate.hpp"

namespace window_ingress::adapters::stamp_faults_test {

nav_msgs::Odometry odometry(const ros::Time& stamp) {
  nav_msgs::Odometry message;
  message.header.stamp = stamp;
  message.header.frame_id = "odom";
  message.child_frame_id = "base_link";
  message.pose.pose.orientation.w = 1.0;
  return message;
}

window_ingress::WindowDetection detection(const ros::Time& stamp) {
  detection::WindowObservation window;
  for (int i = 0; i < 4; ++i) window.corners[i] = {100.0 + 50.0 * i, 100.0};
  window_ingress::WindowDetection message = toMsg(window);
  message.header.stamp = stamp;
  return message;
}

window_ingress::WindowPose target(const ros::Time& stamp) {
  window_ingress::WindowPose message;
  message.filtered.valid = true;
  message.filtered.header.frame_id = "odom";
  message.filtered.header.stamp = stamp;
  message.filtered.pose.pose.orientation.w = 1.0;
  message.size.width = message.size.height = 1.0;
  return message;
}

// Reasons why each of the inputs is refused with this stamp; empty if it is accepted.
std::vector<std::string> refusals(const ros::Time& stamp) {
  StampGate gate{StampLimits{}};  // accepts one image, odometry, window_pose and imu each
  return {gate.whyRefused(stamp, stamp.toSec()).value_or(""), fromMsg(odometry(stamp), FrameNames()).reason,
          fromMsg(detection(stamp)).reason, targetFromMsg(target(stamp), "odom").reason};
}

void expectRefused(const ros::Time& stamp) {
  for (const std::string& reason : refusals(stamp))
    EXPECT_NE(reason.find("zero or not normalised"), std::string::npos) << reason;
}

TEST(Fault, M37_Unstamped) {
  for (const std::string& reason : refusals(ros::Time(12.5))) EXPECT_EQ(reason, "");
  expectRefused(ros::Time());
  RecordProperty("seen", "4 kinds of input: " + refusals(ros::Time())[0]);
}

TEST(Fault, M39_NanosecondsBeyondASecond) {
  for (const std::uint32_t nsec : {1000000000u, 4000000000u, 4294967295u}) {
    ros::Time stamp;
    stamp.sec = 12;
    stamp.nsec = nsec;
    EXPECT_FALSE(stampSec(stamp));
    expectRefused(stamp);
  }
  RecordProperty("seen", "4 kinds of input: dropped, not read as 4 s later");
}

}  // namespace window_ingress::adapters::stamp_faults_test
