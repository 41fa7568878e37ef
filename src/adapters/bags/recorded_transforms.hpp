#pragma once

#include <ros/time.h>
#include <rosbag/bag.h>
#include <tf2/buffer_core.h>
#include <tf2_msgs/TFMessage.h>

#include <Eigen/Geometry>
#include <map>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters {

/// Transforms of a bag that hold for all of it, as the mounting of the camera does.
class RecordedTransforms {
 public:
  /// What is not finite is left out.
  void take(const tf2_msgs::TFMessage& message);
  /// T_to_from, or why it is not known.
  Converted<Eigen::Isometry3d> between(const std::string& to, const std::string& from) const;

 private:
  tf2::BufferCore buffer_;
};

/// T_camera_window by the stamps of the images, as a topic of true poses has it. What is not finite is left
/// out.
std::map<ros::Time, Eigen::Isometry3d> recordedTruth(const rosbag::Bag& bag, const std::string& topic);

}  // namespace window_ingress::adapters
