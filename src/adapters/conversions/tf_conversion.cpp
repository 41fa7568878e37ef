#include "adapters/conversions/tf_conversion.hpp"

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::adapters {

std_msgs::Header headerOf(const ros::Time& stamp, const std::string& frame_id) {
  std_msgs::Header header;
  header.stamp = stamp;
  header.frame_id = frame_id;
  return header;
}

geometry_msgs::TransformStamped toTransformStampedMsg(const Eigen::Isometry3d& pose,
                                                      const std_msgs::Header& header,
                                                      const std::string& child) {
  geometry_msgs::TransformStamped message;
  message.header = header;
  message.child_frame_id = child;
  message.transform = toTransformMsg(pose);
  return message;
}

std::vector<geometry_msgs::TransformStamped> mountingOf(const Eigen::Isometry3d& T_base_camera,
                                                        const ros::Time& stamp, const FrameNames& frames,
                                                        const std::string& camera_frame) {
  const Eigen::Matrix3d R_optical_flu = geometry::R_optical_flu();
  const Eigen::Isometry3d T_base_link =
      geometry::makePose(T_base_camera.linear() * R_optical_flu, T_base_camera.translation());
  const Eigen::Isometry3d T_link_optical =
      geometry::makePose(R_optical_flu.transpose(), Eigen::Vector3d::Zero());
  return {toTransformStampedMsg(T_base_link, headerOf(stamp, frames.base), "camera_link"),
          toTransformStampedMsg(T_link_optical, headerOf(stamp, "camera_link"), camera_frame)};
}

}  // namespace window_ingress::adapters
