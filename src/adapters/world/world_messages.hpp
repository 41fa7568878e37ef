/// Messages of the simulated vehicle, for topics and for the bags of `fly`.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <window_ingress/ReferenceImage.h>

#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "simulation/world.hpp"

namespace window_ingress::adapters {

/// The twist is in the child frame (REP 147). \param twist_in_odom the velocity is in odom axes instead, as
/// in some simulators
nav_msgs::Odometry toOdometryMsg(const simulation::OdometrySample& sample, const ros::Time& stamp,
                                 const FrameNames& frames, bool twist_in_odom = false);
nav_msgs::Odometry toOdometryMsg(const simulation::VehicleTruth& truth, const ros::Time& stamp,
                                 const FrameNames& frames);
/// The photograph that an operator would have taken before the flight.
window_ingress::ReferenceImage toReferenceMsg(const simulation::World& world, const std_msgs::Header& header);
sensor_msgs::Imu toImuMsg(const simulation::ImuSample& sample, const ros::Time& stamp,
                          const FrameNames& frames);
geometry_msgs::PoseStamped toPoseStampedMsg(const Eigen::Isometry3d& pose, const std_msgs::Header& header);
/// The URL of a calibration file for camera_info_manager, or empty. \throws InputError
std::string checkedUrl(const std::string& url);

}  // namespace window_ingress::adapters
