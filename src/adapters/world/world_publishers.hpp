#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Bool.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>
#include <window_ingress/ReferenceImage.h>

#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/images/image_conversion.hpp"
#include "adapters/world/world_messages.hpp"
#include "simulation/world.hpp"

namespace window_ingress::adapters {

/// All topics of the world, except for the referee's verdict.
class WorldPublishers {
 public:
  /// \param complete no message may be lost at a slow subscriber
  WorldPublishers(ros::NodeHandle& nh, const FrameNames& frames, const std::string& camera_frame,
                  bool complete)
      : frames_(frames), camera_frame_(camera_frame), complete_(complete) {
    const int newest = complete ? kCompleteQueue : 1;
    image_ = nh.advertise<sensor_msgs::Image>("image_raw", newest);
    info_ = nh.advertise<sensor_msgs::CameraInfo>("camera_info", newest);
    truth_odom_ = nh.advertise<nav_msgs::Odometry>("ground_truth/odom", newest);
    truth_window_ = nh.advertise<geometry_msgs::PoseStamped>("ground_truth/window", 1, true);
    truth_in_camera_ = nh.advertise<geometry_msgs::PoseStamped>("ground_truth/window_in_camera", newest);
    reference_ = nh.advertise<window_ingress::ReferenceImage>("reference", 1, true);
    target_chosen_ = nh.advertise<std_msgs::Bool>("scenario/target_chosen", 1, true);
  }

  /// Advertises the vehicle's topics and the clock; not for an external vehicle, which publishes them itself.
  void advertiseVehicle(ros::NodeHandle& nh) {
    const int newest = complete_ ? kCompleteQueue : 1, samples = complete_ ? kCompleteQueue : kSampleQueue;
    clock_ = nh.advertise<rosgraph_msgs::Clock>("/clock", newest);
    odom_ = nh.advertise<nav_msgs::Odometry>("odom", samples);
    imu_ = nh.advertise<sensor_msgs::Imu>("imu", samples);
  }

  void clock(const ros::Time& now) {
    rosgraph_msgs::Clock message;
    message.clock = now;
    clock_.publish(message);
  }

  /// Sends the image, if it has subscribers, and its truth. \return whether the image was sent
  bool frame(const simulation::CameraFrame& frame, const ros::Time& stamp) {
    const std_msgs::Header stamped = headerOf(stamp, camera_frame_);
    truth_in_camera_.publish(toPoseStampedMsg(frame.T_camera_window, stamped));
    if (!imagesAreAwaited()) return false;
    image_.publish(toImageMsg(frame.image, stamped));
    return true;
  }

  void cameraInfo(sensor_msgs::CameraInfo info, const ros::Time& stamp) {
    info.header = headerOf(stamp, camera_frame_);
    info_.publish(info);
  }

  void odometry(const simulation::OdometrySample& sample, const ros::Time& stamp) {
    odom_.publish(toOdometryMsg(sample, stamp, frames_, twist_in_odom_));
  }

  void transform(const simulation::OdometrySample& sample, const ros::Time& stamp) {
    tf_.sendTransform(toTransformStampedMsg(sample.T_odom_base, headerOf(stamp, frames_.odom), frames_.base));
  }

  void imu(const simulation::ImuSample& sample, const ros::Time& stamp) {
    imu_.publish(toImuMsg(sample, stamp, frames_));
  }

  /// True state of the vehicle, and of a window that moves.
  void truth(const simulation::World& world, const ros::Time& stamp) {
    truth_odom_.publish(toOdometryMsg(world.truth(), stamp, frames_));
    if (world.scenario().sway.amplitude_m > 0.0) truthOfWindow(world, stamp);
  }

  /// Constants of a flight: the camera's mounting, the window, the reference image, and whether the operator
  /// is to choose the target before the mission starts.
  void facts(const simulation::World& world, const ros::Time& stamp) {
    static_tf_.sendTransform(mountingOf(world.T_base_camera(), stamp, frames_, camera_frame_));
    truthOfWindow(world, stamp);
    reference_.publish(toReferenceMsg(world, headerOf(stamp, camera_frame_)));
    std_msgs::Bool target_chosen;
    target_chosen.data = world.scenario().target_chosen;
    target_chosen_.publish(target_chosen);
    twist_in_odom_ = world.scenario().odometry.twist_frame == "world";
  }

  bool imagesAreAwaited() const { return image_.getNumSubscribers() > 0; }
  bool odometryIsAwaited() const { return odom_.getNumSubscribers() > 0; }

 private:
  static constexpr int kSampleQueue = 10, kCompleteQueue = 1000;

  void truthOfWindow(const simulation::World& world, const ros::Time& stamp) {
    truth_window_.publish(toPoseStampedMsg(world.T_odom_window(), headerOf(stamp, frames_.odom)));
  }

  FrameNames frames_;
  std::string camera_frame_;
  bool complete_;
  bool twist_in_odom_ = false;  // as in some simulators, against REP 147
  tf2_ros::TransformBroadcaster tf_;
  tf2_ros::StaticTransformBroadcaster static_tf_;
  ros::Publisher clock_, image_, info_, odom_, imu_, reference_, target_chosen_;
  ros::Publisher truth_odom_, truth_window_, truth_in_camera_;
};

}  // namespace window_ingress::adapters
