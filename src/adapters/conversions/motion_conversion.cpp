#include <tf2_eigen/tf2_eigen.h>

#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

constexpr const char* kNoStamp = "header.stamp is zero or not normalised";
constexpr double kUnitTolerance = 0.01;
constexpr double kFarthestM = 1e5;  // a position further away is a fault
constexpr double kFastestMps = 100.0, kFastestRadps = 100.0;

std::string frameFault(const char* field, const std::string& found, const std::string& wanted) {
  if (found == wanted) return "";
  return std::string(field) + " is '" + found.substr(0, 60) + "', expected '" + wanted + "'";
}

Converted<Eigen::Isometry3d> poseFrom(const Eigen::Vector3d& position,
                                      const geometry_msgs::Quaternion& orientation) {
  if (!position.allFinite() || position.norm() > kFarthestM)
    return {std::nullopt, "position is not finite or beyond 100 km"};
  const auto rotation = adapters::fromMsg(orientation);
  if (!rotation) return {std::nullopt, rotation.reason};
  return {geometry::makePose(rotation.value->toRotationMatrix(), position), ""};
}

}  // namespace

Converted<Eigen::Quaterniond> fromMsg(const geometry_msgs::Quaternion& message) {
  const Eigen::Quaterniond q(message.w, message.x, message.y, message.z);
  const double norm = q.norm();
  if (!std::isfinite(norm)) return {std::nullopt, "quaternion is not finite"};
  if (std::abs(norm - 1.0) > kUnitTolerance)
    return {std::nullopt, "quaternion has length " + std::to_string(norm) + " instead of 1"};
  return {q.normalized(), ""};
}

Converted<Eigen::Isometry3d> fromMsg(const geometry_msgs::Pose& message) {
  return poseFrom(toEigen(message.position), message.orientation);
}

Converted<Eigen::Isometry3d> fromMsg(const geometry_msgs::Transform& message) {
  return poseFrom(toEigen(message.translation), message.rotation);
}

geometry_msgs::Pose toPoseMsg(const Eigen::Isometry3d& pose) { return tf2::toMsg(pose); }

geometry_msgs::Vector3 toVectorMsg(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  return tf2::toMsg(vector, message);
}

std_msgs::Header headerOf(const ros::Time& stamp, const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  return header;
}

geometry_msgs::TransformStamped toTransformStampedMsg(const Eigen::Isometry3d& pose,
                                                      const std_msgs::Header& header,
                                                      const std::string& child) {
  geometry_msgs::TransformStamped message;
  message.header = header;
  message.child_frame_id = child;
  message.transform = tf2::eigenToTransform(pose).transform;
  return message;
}

std::vector<geometry_msgs::TransformStamped> mountingOf(const Eigen::Isometry3d& T_base_camera,
                                                        const ros::Time& stamp, const FrameNames& frames,
                                                        const std::string& camera_frame) {
  const Eigen::Matrix3d R_optical_flu = geometry::R_optical_flu();
  const Eigen::Isometry3d T_base_link =
      geometry::makePose(T_base_camera.linear() * R_optical_flu, T_base_camera.translation());
  const Eigen::Isometry3d T_link_optical =
      geometry::makePose(R_optical_flu.transpose(), Eigen::Vector3d::Zero());
  return {toTransformStampedMsg(T_base_link, headerOf(stamp, frames.base), "camera_link"),
          toTransformStampedMsg(T_link_optical, headerOf(stamp, "camera_link"), camera_frame)};
}

Converted<navigation::VehicleState> fromMsg(const nav_msgs::Odometry& message, const FrameNames& frames) {
  const auto stamp_sec = stampSec(message.header.stamp);
  if (!stamp_sec) return {std::nullopt, kNoStamp};
  std::string fault = frameFault("header.frame_id", message.header.frame_id, frames.odom);
  if (fault.empty()) fault = frameFault("child_frame_id", message.child_frame_id, frames.base);
  if (!fault.empty()) return {std::nullopt, fault};
  const auto pose = fromMsg(message.pose.pose);
  if (!pose) return {std::nullopt, pose.reason};
  const Eigen::Vector3d velocity_base = toEigen(message.twist.twist.linear);
  if (!velocity_base.allFinite() || velocity_base.norm() > kFastestMps)
    return {std::nullopt, "velocity is not finite or above 100 m/s"};
  navigation::VehicleState state;
  state.stamp_sec = *stamp_sec;
  state.T_odom_base = *pose.value;
  state.velocity_odom_mps = pose.value->linear() * velocity_base;
  const Eigen::Vector3d turn_base = toEigen(message.twist.twist.angular);
  if (turn_base.norm() < kFastestRadps) state.turn_odom_radps = pose.value->linear() * turn_base;
  return {state, ""};
}

Converted<StampedAttitude> fromMsg(const sensor_msgs::Imu& message, const std::string& base_frame) {
  const auto stamp_sec = stampSec(message.header.stamp);
  if (!stamp_sec) return {std::nullopt, kNoStamp};
  const std::string fault = frameFault("the IMU's header.frame_id", message.header.frame_id, base_frame);
  if (!fault.empty()) return {std::nullopt, fault};
  if (message.orientation_covariance[0] == -1.0)
    return {std::nullopt, "the IMU says that it has no orientation (covariance -1)"};
  const auto rotation = fromMsg(message.orientation);
  if (!rotation) return {std::nullopt, rotation.reason};
  return {StampedAttitude{*stamp_sec, *rotation.value}, ""};
}

geometry_msgs::TwistStamped toTwistMsg(const navigation::Setpoint& setpoint, const FrameNames& frames,
                                       const std::optional<Eigen::Matrix3d>& R_odom_base) {
  const Eigen::Matrix3d R_odom_frame = R_odom_base.value_or(Eigen::Matrix3d::Identity());
  geometry_msgs::TwistStamped message;
  message.header.frame_id = R_odom_base ? frames.base : frames.odom;
  message.twist.linear = toVectorMsg(R_odom_frame.transpose() * setpoint.velocity_odom_mps);
  message.twist.angular =
      toVectorMsg(R_odom_frame.transpose() * Eigen::Vector3d(0.0, 0.0, setpoint.yaw_rate_radps));
  return message;
}

Converted<navigation::Setpoint> fromMsg(const geometry_msgs::TwistStamped& message, const FrameNames& frames,
                                        const Eigen::Matrix3d& R_odom_base) {
  const bool in_base = message.header.frame_id == frames.base;
  if (!in_base && message.header.frame_id != frames.odom)
    return {std::nullopt, "header.frame_id is '" + message.header.frame_id.substr(0, 60) + "', expected '" +
                              frames.odom + "' or '" + frames.base + "'"};
  const Eigen::Vector3d linear = toEigen(message.twist.linear), angular = toEigen(message.twist.angular);
  if (!linear.allFinite() || !angular.allFinite()) return {std::nullopt, "velocity is not finite"};
  const Eigen::Matrix3d R_odom_frame = in_base ? R_odom_base : Eigen::Matrix3d(Eigen::Matrix3d::Identity());
  navigation::Setpoint setpoint;
  setpoint.velocity_odom_mps = R_odom_frame * linear;
  setpoint.yaw_rate_radps = (R_odom_frame * angular).z();
  return {setpoint, ""};
}

}  // namespace window_ingress::adapters
