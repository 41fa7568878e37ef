#pragma once

#include <ros/node_handle.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "simulation/world.hpp"

namespace window_ingress::adapters {

/// Everything that the world says on topics, but for its referee's verdict.
class WorldPublishers {
 public:
  /// \param complete nothing may be lost where a subscriber is slow
  WorldPublishers(ros::NodeHandle& nh, const FrameNames& frames, const std::string& camera_frame,
                  bool complete);
  /// What the vehicle says, and time; not for one that is simulated elsewhere, which says it itself.
  void advertiseVehicle(ros::NodeHandle& nh);

  void clock(const ros::Time& now);
  /// The image, if somebody listens, and the truth that belongs to it. \return whether it was sent
  bool frame(const simulation::CameraFrame& frame, const ros::Time& stamp);
  void cameraInfo(sensor_msgs::CameraInfo info, const ros::Time& stamp);
  void odometry(const simulation::OdometrySample& sample, const ros::Time& stamp);
  void transform(const simulation::OdometrySample& sample, const ros::Time& stamp);
  void imu(const simulation::ImuSample& sample, const ros::Time& stamp);
  /// Of the vehicle, and of a window that moves.
  void truth(const simulation::World& world, const ros::Time& stamp);
  /// What does not change during a flight: camera's mounting, the window, the reference image, and whether
  /// the operator is to choose the target before the mission starts.
  void facts(const simulation::World& world, const ros::Time& stamp);

  bool imagesAreAwaited() const { return image_.getNumSubscribers() > 0; }
  bool odometryIsAwaited() const { return odom_.getNumSubscribers() > 0; }

 private:
  void truthOfWindow(const simulation::World& world, const ros::Time& stamp);
  FrameNames frames_;
  std::string camera_frame_;
  bool complete_;
  bool twist_in_odom_ = false;  // as some simulators say it, against REP 147
  tf2_ros::TransformBroadcaster tf_;
  tf2_ros::StaticTransformBroadcaster static_tf_;
  ros::Publisher clock_, image_, info_, odom_, imu_, reference_, target_chosen_;
  ros::Publisher truth_odom_, truth_window_, truth_in_camera_;
};

}  // namespace window_ingress::adapters
