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

/// The vehicle's attitude at the time of an image, from tf. A transform may come later than the image:
/// that one goes without, and only what lasts is told.
class TfAttitude {
 public:
  TfAttitude(const tf2_ros::Buffer& tf, const std::string& odom_frame, const std::string& base_frame);

  std::optional<Eigen::Quaterniond> at(double stamp_sec);
  Health health() const;

 private:
  const tf2_ros::Buffer& tf_;
  std::string odom_frame_, base_frame_, fault_;
  double known_sec_, asked_sec_;  // when it was last known and last asked for, on the steady clock
};

/// Where the camera is mounted on the vehicle, as tf says now, or why it is not known.
Converted<Eigen::Isometry3d> mountingOf(const tf2_ros::Buffer& tf, const std::string& base_frame,
                                        const std::string& camera_frame);

/// Attitude of the camera at the exposure of an image: `imu`, interpolated, and the camera's mounting in tf.
/// Help, no need: who asks does without where it is not known, and diagnostics say why.
class AttitudeSource {
 public:
  /// Subscribes to `imu` and to tf.
  AttitudeSource(ros::NodeHandle& nh, Diagnostics& diagnostics, const std::string& base_frame, int queue);

  std::optional<Eigen::Matrix3d> R_world_camera(double stamp_sec, const std::string& camera_frame);

  /// For lockstep: stamp of the message that came last, whether all is there, and something to call when a
  /// message has come.
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
