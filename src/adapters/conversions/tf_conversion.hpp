#pragma once

#include <geometry_msgs/TransformStamped.h>

#include <string>
#include <vector>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters {

std_msgs::Header headerOf(const ros::Time& stamp, const std::string& frame_id);

geometry_msgs::TransformStamped toTransformStampedMsg(const Eigen::Isometry3d& pose,
                                                      const std_msgs::Header& header,
                                                      const std::string& child);

/// base_link -> camera_link (forward-left-up) -> `camera_frame` (right-down-forward), REP 103.
std::vector<geometry_msgs::TransformStamped> mountingOf(const Eigen::Isometry3d& T_base_camera,
                                                        const ros::Time& stamp, const FrameNames& frames,
                                                        const std::string& camera_frame);

}  // namespace window_ingress::adapters
