#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>

#include <functional>
#include <string>
#include <utility>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/runtime/topic_health.hpp"

namespace window_ingress::adapters {

/// The calibration as last heard: camera_info and images are not paired by stamp, they only have to fit in
/// size and frame. A new calibration counts from the next image on; one that cannot be used withdraws the one
/// before. Diagnostics tell what does not fit, and stamps that are apart.
class CameraSource {
 public:
  /// Subscribes to `camera_info`.
  /// \param rectified images are rectified, see `cameraFromMsg`
  CameraSource(ros::NodeHandle& nh, Diagnostics& diagnostics, bool rectified);

  /// The camera of an image of this size, or why there is none. An empty `frame_id` fits every frame.
  Converted<geometry::PinholeCamera> cameraOf(int width_px, int height_px, const std_msgs::Header& image);

  void receive(const sensor_msgs::CameraInfo& message);

  /// For lockstep: stamp of the message that came last, and something to call when one has come.
  ros::Time lastStamp() const { return stamp_; }
  bool isConnected() const { return subscriber_.getNumPublishers() > 0; }
  void notify(std::function<void()> came) { came_ = std::move(came); }

 private:
  std::string misfit(int width_px, int height_px, const std::string& frame_id) const;
  void compareStamps(const ros::Time& image);
  Health fitHealth() const;

  std::string undoneTwice() const;

  bool rectified_;
  std::string image_topic_;
  Converted<geometry::PinholeCamera> camera_;
  std::string frame_id_;
  ros::Time stamp_;
  std::string misfit_;
  double apart_sec_ = 0.0, together_sec_ = 0.0;  // of stamps; when they were last near, on the steady clock
  std::function<void()> came_;
  TopicHealth health_;
  ros::Subscriber subscriber_;
};

}  // namespace window_ingress::adapters
