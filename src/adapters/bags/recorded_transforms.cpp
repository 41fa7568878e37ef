#include "adapters/bags/recorded_transforms.hpp"

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

}  // namespace window_ingress::adapters
