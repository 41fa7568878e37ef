#include "adapters/world/world_publishers.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Imu.h>
#include <std_msgs/Bool.h>
#include <window_ingress/ReferenceImage.h>

#include "adapters/images/image_conversion.hpp"
#include "adapters/world/world_messages.hpp"

namespace window_ingress::adapters {
namespace {

constexpr int kSampleQueue = 10, kCompleteQueue = 1000;

}  // namespace

WorldPublishers::WorldPublishers(ros::NodeHandle& nh, const FrameNames& frames,
                                 const std::string& camera_frame, bool complete)
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

void WorldPublishers::advertiseVehicle(ros::NodeHandle& nh) {
  const int newest = complete_ ? kCompleteQueue : 1, samples = complete_ ? kCompleteQueue : kSampleQueue;
  clock_ = nh.advertise<rosgraph_msgs::Clock>("/clock", newest);
  odom_ = nh.advertise<nav_msgs::Odometry>("odom", samples);
  imu_ = nh.advertise<sensor_msgs::Imu>("imu", samples);
}

void WorldPublishers::clock(const ros::Time& now) {
  rosgraph_msgs::Clock message;
  message.clock = now;
  clock_.publish(message);
}

bool WorldPublishers::frame(const simulation::CameraFrame& frame, const ros::Time& stamp) {
  const std_msgs::Header stamped = headerOf(stamp, camera_frame_);
  truth_in_camera_.publish(toPoseStampedMsg(frame.T_camera_window, stamped));
  if (!imagesAreAwaited()) return false;
  image_.publish(toImageMsg(frame.image, stamped));
  return true;
}

void WorldPublishers::cameraInfo(sensor_msgs::CameraInfo info, const ros::Time& stamp) {
  info.header = headerOf(stamp, camera_frame_);
  info_.publish(info);
}

void WorldPublishers::odometry(const simulation::OdometrySample& sample, const ros::Time& stamp) {
  odom_.publish(toOdometryMsg(sample, stamp, frames_, twist_in_odom_));
}

void WorldPublishers::transform(const simulation::OdometrySample& sample, const ros::Time& stamp) {
  tf_.sendTransform(toTransformStampedMsg(sample.T_odom_base, headerOf(stamp, frames_.odom), frames_.base));
}

void WorldPublishers::imu(const simulation::ImuSample& sample, const ros::Time& stamp) {
  imu_.publish(toImuMsg(sample, stamp, frames_));
}

void WorldPublishers::truth(const simulation::World& world, const ros::Time& stamp) {
  truth_odom_.publish(toOdometryMsg(world.truth(), stamp, frames_));
  if (world.scenario().sway.amplitude_m > 0.0) truthOfWindow(world, stamp);
}

void WorldPublishers::truthOfWindow(const simulation::World& world, const ros::Time& stamp) {
  truth_window_.publish(toPoseStampedMsg(world.T_odom_window(), headerOf(stamp, frames_.odom)));
}

void WorldPublishers::facts(const simulation::World& world, const ros::Time& stamp) {
  static_tf_.sendTransform(mountingOf(world.T_base_camera(), stamp, frames_, camera_frame_));
  truthOfWindow(world, stamp);
  reference_.publish(toReferenceMsg(world, headerOf(stamp, camera_frame_)));
  std_msgs::Bool target_chosen;
  target_chosen.data = world.scenario().target_chosen;
  target_chosen_.publish(target_chosen);
  twist_in_odom_ = world.scenario().odometry.twist_frame == "world";
}

}  // namespace window_ingress::adapters
