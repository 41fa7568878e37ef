#include "adapters/camera_source.hpp"

#include "adapters/guarded.hpp"

namespace window_ingress::adapters {
namespace {

constexpr double kSilenceSec = 2.0;

std::string size(int width, int height) { return std::to_string(width) + "x" + std::to_string(height); }

}  // namespace

CameraSource::CameraSource(ros::NodeHandle& nh, Diagnostics& diagnostics, bool rectified)
    : rectified_(rectified), health_(diagnostics, "camera_info", kSilenceSec) {
  subscriber_ = subscribeGuarded<sensor_msgs::CameraInfo>(nh, "camera_info", 1, diagnostics,
                                                          [this](const auto& message) { receive(*message); });
  health_.watch(subscriber_);
  camera_.reason = "no camera_info on " + subscriber_.getTopic() + " so far";
}

void CameraSource::receive(const sensor_msgs::CameraInfo& message) {
  health_.arrived();
  camera_ = cameraFromMsg(message, rectified_);
  frame_id_ = message.header.frame_id;
  stamp_ = message.header.stamp;
  if (camera_)
    health_.accepted();
  else
    health_.refused(camera_.reason);
  if (came_) came_();
}

std::string CameraSource::fault(int width_px, int height_px, const std::string& frame_id) const {
  if (!camera_) return camera_.reason;
  if (camera_.value->width != width_px || camera_.value->height != height_px)
    return "sizes differ: the image has " + size(width_px, height_px) + " pixels, camera_info is for " +
           size(camera_.value->width, camera_.value->height);
  if (!frame_id.empty() && frame_id != frame_id_)
    return "frames differ: the image has frame_id '" + frame_id + "', camera_info '" + frame_id_ + "'";
  return "";
}

Converted<geometry::PinholeCamera> CameraSource::cameraOf(int width_px, int height_px,
                                                          const std::string& frame_id) const {
  const std::string reason = fault(width_px, height_px, frame_id);
  if (!reason.empty()) return {std::nullopt, reason};
  return camera_;
}

}  // namespace window_ingress::adapters
