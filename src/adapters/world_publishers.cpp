#include "adapters/world_publishers.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <rosgraph_msgs/Clock.h>
#include <sensor_msgs/Imu.h>
#include <window_ingress/ReferencePicture.h>

#include "adapters/image_message.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {
namespace {

constexpr int kSampleQueue = 10, kCompleteQueue = 1000;

std_msgs::Header header(const ros::Time& stamp, const std::string& frame_id) {
  std_msgs::Header out;
  out.stamp = stamp;
  out.frame_id = frame_id;
  return out;
}

nav_msgs::Odometry toOdometryMsg(const Eigen::Isometry3d& T_odom_base,
                                 const Eigen::Vector3d& velocity_odom_mps,
                                 const Eigen::Vector3d& angular_velocity_base_radps) {
  nav_msgs::Odometry message;
  message.pose.pose = toPoseMsg(T_odom_base);
  message.twist.twist.linear = toVectorMsg(T_odom_base.linear().transpose() * velocity_odom_mps);
  message.twist.twist.angular = toVectorMsg(angular_velocity_base_radps);
  return message;
}

geometry_msgs::PoseStamped toPoseStamped(const Eigen::Isometry3d& pose, const std_msgs::Header& stamped) {
  geometry_msgs::PoseStamped message;
  message.header = stamped;
  message.pose = toPoseMsg(pose);
  return message;
}

geometry_msgs::TransformStamped toStampedTransform(const Eigen::Isometry3d& pose,
                                                   const std_msgs::Header& stamped,
                                                   const std::string& child) {
  geometry_msgs::TransformStamped message;
  message.header = stamped;
  message.child_frame_id = child;
  message.transform = toTransformMsg(pose);
  return message;
}

}  // namespace

WorldPublishers::WorldPublishers(ros::NodeHandle& nh, const FrameNames& frames,
                                 const std::string& camera_frame, bool complete)
    : frames_(frames), camera_frame_(camera_frame) {
  const int newest = complete ? kCompleteQueue : 1, samples = complete ? kCompleteQueue : kSampleQueue;
  clock_ = nh.advertise<rosgraph_msgs::Clock>("/clock", newest);
  image_ = nh.advertise<sensor_msgs::Image>("image_raw", newest);
  info_ = nh.advertise<sensor_msgs::CameraInfo>("camera_info", newest);
  odom_ = nh.advertise<nav_msgs::Odometry>("odom", samples);
  imu_ = nh.advertise<sensor_msgs::Imu>("imu", samples);
  truth_odom_ = nh.advertise<nav_msgs::Odometry>("ground_truth/odom", newest);
  truth_window_ = nh.advertise<geometry_msgs::PoseStamped>("ground_truth/window", 1, true);
  truth_in_camera_ = nh.advertise<geometry_msgs::PoseStamped>("ground_truth/window_in_camera", newest);
  reference_ = nh.advertise<window_ingress::ReferencePicture>("reference", 1, true);
}

void WorldPublishers::clock(const ros::Time& now) {
  rosgraph_msgs::Clock message;
  message.clock = now;
  clock_.publish(message);
}

bool WorldPublishers::frame(const simulation::CameraFrame& frame, const ros::Time& stamp) {
  const std_msgs::Header stamped = header(stamp, camera_frame_);
  truth_in_camera_.publish(toPoseStamped(frame.T_camera_window, stamped));
  if (!imagesAreAwaited()) return false;
  image_.publish(toImageMsg(frame.image, stamped));
  return true;
}

void WorldPublishers::cameraInfo(sensor_msgs::CameraInfo info, const ros::Time& stamp) {
  info.header = header(stamp, camera_frame_);
  info_.publish(info);
}

void WorldPublishers::odometry(const simulation::OdometrySample& sample, const ros::Time& stamp) {
  nav_msgs::Odometry message =
      toOdometryMsg(sample.T_odom_base, sample.velocity_odom_mps, sample.angular_velocity_base_radps);
  message.header = header(stamp, frames_.odom);
  message.child_frame_id = frames_.base;
  odom_.publish(message);
}

void WorldPublishers::transform(const simulation::OdometrySample& sample, const ros::Time& stamp) {
  tf_.sendTransform(toStampedTransform(sample.T_odom_base, header(stamp, frames_.odom), frames_.base));
}

void WorldPublishers::imu(const simulation::ImuSample& sample, const ros::Time& stamp) {
  sensor_msgs::Imu message;
  message.header = header(stamp, frames_.base);
  message.orientation.x = sample.R_odom_base.x();
  message.orientation.y = sample.R_odom_base.y();
  message.orientation.z = sample.R_odom_base.z();
  message.orientation.w = sample.R_odom_base.w();
  message.angular_velocity = toVectorMsg(sample.angular_velocity_base_radps);
  message.linear_acceleration = toVectorMsg(sample.specific_force_base_mps2);
  imu_.publish(message);
}

void WorldPublishers::truth(const simulation::VehicleTruth& truth, const ros::Time& stamp) {
  nav_msgs::Odometry message =
      toOdometryMsg(truth.T_odom_base, truth.velocity_odom_mps, truth.angular_velocity_base_radps);
  message.header = header(stamp, frames_.odom);
  message.child_frame_id = frames_.base;
  truth_odom_.publish(message);
}

void WorldPublishers::facts(const simulation::World& world, const ros::Time& stamp) {
  mounting(world.T_base_camera(), stamp);
  truth_window_.publish(toPoseStamped(world.T_odom_window(), header(stamp, frames_.odom)));
  reference(world, stamp);
}

// base_link -> camera_link (forward-left-up) -> camera_optical_frame (right-down-forward), REP 103.
void WorldPublishers::mounting(const Eigen::Isometry3d& T_base_camera, const ros::Time& stamp) {
  const Eigen::Matrix3d R_optical_flu = geometry::R_optical_flu();
  const Eigen::Isometry3d T_base_link =
      geometry::makePose(T_base_camera.linear() * R_optical_flu, T_base_camera.translation());
  const Eigen::Isometry3d T_link_optical =
      geometry::makePose(R_optical_flu.transpose(), Eigen::Vector3d::Zero());
  static_tf_.sendTransform(std::vector<geometry_msgs::TransformStamped>{
      toStampedTransform(T_base_link, header(stamp, frames_.base), "camera_link"),
      toStampedTransform(T_link_optical, header(stamp, "camera_link"), camera_frame_)});
}

// What an operator would have photographed before the flight.
void WorldPublishers::reference(const simulation::World& world, const ros::Time& stamp) {
  geometry::Quadrilateral corners;
  window_ingress::ReferencePicture message;
  message.picture = *toImageMsg(world.referencePicture(&corners), header(stamp, camera_frame_));
  for (std::size_t i = 0; i < 4; ++i) {
    message.corner_x[i] = corners[i].x();
    message.corner_y[i] = corners[i].y();
  }
  reference_.publish(message);
}

}  // namespace window_ingress::adapters
