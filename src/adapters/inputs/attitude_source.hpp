#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {

/// The vehicle's attitude at the time of an image, from tf. An image does without if its transform comes
/// late; only a lasting lack is reported.
class TfAttitude {
 public:
  TfAttitude(const tf2_ros::Buffer& tf, const std::string& odom_frame, const std::string& base_frame)
      : tf_(tf),
        odom_frame_(odom_frame),
        base_frame_(base_frame),
        known_sec_(steadyNowSec()),
        asked_sec_(known_sec_ - 2.0 * kSilenceSec) {}

  std::optional<Eigen::Quaterniond> at(double stamp_sec) {
    asked_sec_ = steadyNowSec();
    try {
      const auto found = tf_.lookupTransform(odom_frame_, base_frame_, toStamp(stamp_sec));
      const auto rotation = fromMsg(found.transform.rotation);
      fault_ = rotation.reason;
      if (rotation) known_sec_ = asked_sec_;
      return rotation.value;
    } catch (const tf2::TransformException& error) {
      fault_ = error.what();
      return std::nullopt;
    }
  }

  Health health() const {
    const double now_sec = steadyNowSec();
    const bool asked = now_sec - asked_sec_ < kSilenceSec;
    const bool lasts = now_sec - known_sec_ > kSilenceSec;
    if (fault_.empty() || !asked || !lasts) return {};
    return {Health::kError, "no attitude: " + odom_frame_ + " <- " + base_frame_ +
                                " is not in tf at the time of the image: " + fault_};
  }

 private:
  const tf2_ros::Buffer& tf_;
  std::string odom_frame_, base_frame_, fault_;
  double known_sec_, asked_sec_;  // times of the last success and the last request, on the steady clock
};

/// The camera's present mounting on the vehicle in tf, or the reason why it is unknown.
inline Converted<Eigen::Isometry3d> mountingOf(const tf2_ros::Buffer& tf, const std::string& base_frame,
                                               const std::string& camera_frame) {
  const std::string which = "camera mounting " + base_frame + " <- '" + camera_frame + "': ";
  if (camera_frame.empty()) return {std::nullopt, which + "the image has no frame_id"};
  try {
    const auto pose = fromMsg(tf.lookupTransform(base_frame, camera_frame, ros::Time(0)).transform);
    return pose ? pose : Converted<Eigen::Isometry3d>{std::nullopt, which + pose.reason};
  } catch (const tf2::TransformException& error) {
    return {std::nullopt, which + "not in tf: " + error.what()};
  }
}

/// Attitude of the camera at the exposure of an image: `imu`, interpolated, and the camera's mounting in tf.
/// The attitude is optional: without it images are still used, and diagnostics give the reason.
class AttitudeSource {
 public:
  /// Subscribes to `imu` and to tf.
  AttitudeSource(ros::NodeHandle& nh, Diagnostics& diagnostics, const std::string& base_frame, int queue)
      : base_frame_(base_frame), tf_listener_(tf_) {
    subscriber_ = diagnostics.subscribe(nh, "imu", queue, &AttitudeSource::receive, this);
    diagnostics.add("attitude", [this] { return health(); });
  }

  std::optional<Eigen::Matrix3d> R_world_camera(double stamp_sec, const std::string& camera_frame) {
    missing_ = refusal_;
    const auto T_world_base = attitudes_.at(stamp_sec, kMaxGapSec);
    if (!T_world_base && missing_.empty())
      missing_ = "nothing on " + subscriber_.getTopic() + " near the exposure";
    if (!T_world_base) return std::nullopt;
    const auto T_base_camera = mountingOf(tf_, base_frame_, camera_frame);
    missing_ = T_base_camera.reason;
    if (!T_base_camera) return std::nullopt;
    return T_world_base->linear() * T_base_camera.value->linear();
  }

  /// For lockstep: stamp of the last message, and whether all inputs are connected.
  ros::Time lastStamp() const { return stamp_; }
  bool isConnected(const std::string& camera_frame) const {
    return subscriber_.getNumPublishers() > 0 && mountingOf(tf_, base_frame_, camera_frame);
  }

 private:
  static constexpr double kMaxGapSec = 0.02;  // small: a turn is measured by the difference of two attitudes

  void receive(const sensor_msgs::ImuConstPtr& message) {
    const auto attitude = fromMsg(*message, base_frame_);
    refusal_ = attitude.reason;
    if (attitude)
      attitudes_.add(
          attitude.value->stamp_sec,
          geometry::makePose(attitude.value->R_odom_base.toRotationMatrix(), Eigen::Vector3d::Zero()));
    stamp_ = message->header.stamp;
  }

  Health health() const {
    if (missing_.empty()) return {Health::kOk, "known at the last image"};
    return {Health::kOk, "not known at the last image; tracking uses the image alone: " + missing_};
  }

  std::string base_frame_;
  estimation::PoseBuffer attitudes_;
  ros::Time stamp_;
  std::string refusal_, missing_ = "no image so far";
  tf2_ros::Buffer tf_;
  tf2_ros::TransformListener tf_listener_;
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
