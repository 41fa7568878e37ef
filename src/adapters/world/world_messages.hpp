/// What the simulated vehicle says, as messages: the same on topics and in the bags of `fly`.
#pragma once

#include <geometry_msgs/PoseStamped.h>
#include <nav_msgs/Odometry.h>
#include <sensor_msgs/Imu.h>
#include <window_ingress/ReferenceImage.h>

#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "simulation/world.hpp"

namespace window_ingress::adapters {

/// The twist stands in the child frame (REP 147). \param twist_in_odom the velocity stands in the axes of
/// odom instead, as some simulators have it
nav_msgs::Odometry toOdometryMsg(const simulation::OdometrySample& sample, const ros::Time& stamp,
                                 const FrameNames& frames, bool twist_in_odom = false);
nav_msgs::Odometry toOdometryMsg(const simulation::VehicleTruth& truth, const ros::Time& stamp,
                                 const FrameNames& frames);
/// What an operator would have photographed before the flight.
window_ingress::ReferenceImage toReferenceMsg(const simulation::World& world, const std_msgs::Header& header);
sensor_msgs::Imu toImuMsg(const simulation::ImuSample& sample, const ros::Time& stamp,
                          const FrameNames& frames);
geometry_msgs::PoseStamped toPoseStampedMsg(const Eigen::Isometry3d& pose, const std_msgs::Header& header);
/// The address of a calibration file as camera_info_manager has it, or none. \throws InputError
std::string checkedUrl(const std::string& url);

}  // namespace window_ingress::adapters
