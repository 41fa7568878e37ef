#pragma once

#include <ros/node_handle.h>
#include <sensor_msgs/CameraInfo.h>
#include <std_msgs/Header.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/inputs/topic_input.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {

/// The latest calibration. camera_info and images are not paired by stamp; only size and frame must match. A
/// new calibration applies from the next image on, and an unusable one invalidates the previous. Diagnostics
/// report mismatches and distant stamps.
class CameraSource {
 public:
  /// Subscribes to `camera_info`.
  /// \param rectified images are rectified, see `cameraFromMsg`
  CameraSource(ros::NodeHandle& nh, Diagnostics& diagnostics, bool rectified)
      : rectified_(rectified), image_topic_(nh.resolveName("image_raw")), input_(diagnostics, "camera_info") {
    input_.subscribe(nh, 1, &CameraSource::receive, this);
    diagnostics.add("calibration", [this] { return fitHealth(); });
    camera_.reason = "no camera_info on " + input_.topic() + " so far";
  }

  /// The camera for an image of this size, or the reason why not. An empty `frame_id` matches every frame.
  Converted<geometry::PinholeCamera> cameraOf(int width_px, int height_px, const std_msgs::Header& image) {
    misfit_ = camera_
                  ? misfitOf(*camera_.value, frame_id_, input_.topic(), width_px, height_px, image.frame_id)
                  : "";
    if (camera_) compareStamps(image.stamp);
    return misfit_.empty() ? camera_ : Converted<geometry::PinholeCamera>{std::nullopt, misfit_};
  }

  const TopicInput& input() const { return input_; }

 private:
  static constexpr double kNearSec = 0.2;  // stamps of an image and its calibration may be one frame apart
  // Longest time without near stamps: camera_info may come once a second.
  static constexpr double kApartSec = 1.2;

  void receive(const sensor_msgs::CameraInfoConstPtr& message) {
    input_.admits(message->header.stamp);
    camera_ = cameraFromMsg(*message, rectified_);
    frame_id_ = message->header.frame_id;
    if (camera_)
      input_.accepted();
    else
      input_.refused(camera_.reason);
  }

  void compareStamps(const ros::Time& image) {
    apart_sec_ = image.toSec() - input_.lastStamp().toSec();
    // Where images take long, the calibration of later ones has come already.
    const double age_sec = std::max(0.0, ros::Time::now().toSec() - image.toSec());
    if (apart_sec_ < 0.0) apart_sec_ = std::min(0.0, apart_sec_ + age_sec);
    if (std::abs(apart_sec_) <= kNearSec || together_sec_ == 0.0) together_sec_ = steadyNowSec();
  }

  Health fitHealth() const {
    if (!camera_) return {Health::kOk, "none so far"};
    if (!misfit_.empty()) return {Health::kError, misfit_};
    const bool apart = std::abs(apart_sec_) > kNearSec && steadyNowSec() - together_sec_ > kApartSec;
    const std::string topic = "camera_info on " + input_.topic();
    if (apart && input_.lastStamp().isZero()) return {Health::kWarn, topic + " is not stamped"};
    if (apart)
      return {Health::kWarn,
              formatted("stamps of image and %s are %.2f s apart, the image is %s", topic.c_str(),
                        std::abs(apart_sec_), apart_sec_ > 0.0 ? "newer" : "older")};
    if (const std::string twice = undoneTwice(); !twice.empty()) return {Health::kWarn, twice};
    return {Health::kOk, "fits the image", {{"stamps_apart_s", apart_sec_}}};
  }

  // An image does not show whether it was rectified already; the name of its topic may.
  std::string undoneTwice() const {
    const auto& lens = camera_.value->distortion;
    const bool bends = std::any_of(lens.begin(), lens.end(), [](double number) { return number != 0.0; });
    if (rectified_ || !bends || image_topic_.find("rect") == std::string::npos) return "";
    return "images on " + image_topic_ + " seem to be rectified, but the distortion of camera_info on " +
           input_.topic() + " is removed again; if they are rectified, set vehicle/image_is_rectified";
  }

  bool rectified_;
  std::string image_topic_;
  Converted<geometry::PinholeCamera> camera_;
  std::string frame_id_;
  std::string misfit_;
  double apart_sec_ = 0.0, together_sec_ = 0.0;  // difference of stamps; last time near, on the steady clock
  TopicInput input_;
};

}  // namespace window_ingress::adapters
