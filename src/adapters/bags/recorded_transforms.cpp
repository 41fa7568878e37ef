#include "adapters/bags/recorded_transforms.hpp"

#include <geometry_msgs/PoseStamped.h>
#include <rosbag/view.h>
#include <tf2/exceptions.h>

namespace window_ingress::adapters {

void RecordedTransforms::take(const tf2_msgs::TFMessage& message) {
  for (const geometry_msgs::TransformStamped& transform : message.transforms)
    if (fromMsg(transform.transform)) buffer_.setTransform(transform, "bag", true);
}

Converted<Eigen::Isometry3d> RecordedTransforms::between(const std::string& to,
                                                         const std::string& from) const {
  try {
    return fromMsg(buffer_.lookupTransform(to, from, ros::Time(0)).transform);
  } catch (const tf2::TransformException& error) {
    return {std::nullopt, error.what()};
  }
}

std::map<ros::Time, Eigen::Isometry3d> recordedTruth(const rosbag::Bag& bag, const std::string& topic) {
  std::map<ros::Time, Eigen::Isometry3d> truth;
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery(topic)))
    if (const auto pose = message.instantiate<geometry_msgs::PoseStamped>())
      if (const auto T_camera_window = fromMsg(pose->pose))
        truth[pose->header.stamp] = *T_camera_window.value;
  return truth;
}

}  // namespace window_ingress::adapters
