#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/Imu.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/pose_buffer.hpp"

namespace window_ingress::adapters {

/// The vehicle's attitude at the time of an image, from tf. An image does without if its transform comes
/// late; only a lasting lack is reported.
class TfAttitude {
 public:
  TfAttitude(const tf2_ros::Buffer& tf, const std::string& odom_frame, const std::string& base_frame);

  std::optional<Eigen::Quaterniond> at(double stamp_sec);
  Health health() const;

 private:
  const tf2_ros::Buffer& tf_;
  std::string odom_frame_, base_frame_, fault_;
  double known_sec_, asked_sec_;  // times of the last success and the last request, on the steady clock
};

/// The camera's present mounting on the vehicle in tf, or the reason why it is unknown.
Converted<Eigen::Isometry3d> mountingOf(const tf2_ros::Buffer& tf, const std::string& base_frame,
                                        const std::string& camera_frame);

/// Attitude of the camera at the exposure of an image: `imu`, interpolated, and the camera's mounting in tf.
/// The attitude is optional: without it images are still used, and diagnostics give the reason.
class AttitudeSource {
 public:
  /// Subscribes to `imu` and to tf.
  AttitudeSource(ros::NodeHandle& nh, Diagnostics& diagnostics, const std::string& base_frame, int queue);

  std::optional<Eigen::Matrix3d> R_world_camera(double stamp_sec, const std::string& camera_frame);

  /// For lockstep: stamp of the last message, whether all inputs are connected, and a function to call after
  /// each message.
  ros::Time lastStamp() const { return stamp_; }
  bool isConnected(const std::string& camera_frame) const;
  void notify(std::function<void()> came) { came_ = std::move(came); }

 private:
  void receive(const sensor_msgs::Imu& message);
  Health health() const;

  std::string base_frame_;
  estimation::PoseBuffer attitudes_;
  ros::Time stamp_;
  std::string refusal_, missing_ = "no image so far";
  std::function<void()> came_;
  tf2_ros::Buffer tf_;
  tf2_ros::TransformListener tf_listener_;
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
