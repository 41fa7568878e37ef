#pragma once

#include <std_msgs/Header.h>

#include <deque>
#include <functional>
#include <optional>
#include <utility>

#include "adapters/images/image_conversion.hpp"

namespace window_ingress::adapters {

/// Queue of a bag's images. Each image waits for the inputs of its exposure: odometry at least as new as the
/// image, and the attitude for a limited time only, because attitudes may have stopped.
class WaitingImages {
 public:
  struct Image {
    std_msgs::Header header;
    std::function<DecodedImage()> decode;
  };

  WaitingImages(bool for_odometry, bool for_attitude)
      : for_odometry_(for_odometry), for_attitude_(for_attitude) {}

  void add(Image image) { images_.push_back(std::move(image)); }
  void noteOdometry(double stamp_sec) { odometry_sec_ = stamp_sec; }
  void noteAttitude(double stamp_sec) { attitude_sec_ = stamp_sec; }

  /// The first image, if its inputs are complete. \param newest_sec newest stamp of all messages so far
  std::optional<Image> takeComplete(double newest_sec) {
    const bool too_many = images_.size() > kMaxWaiting;
    if (!too_many && (images_.empty() || !isComplete(images_.front(), newest_sec))) return std::nullopt;
    return take();
  }

  /// The first image, complete or not.
  std::optional<Image> take() {
    if (images_.empty()) return std::nullopt;
    std::optional<Image> first = std::move(images_.front());
    images_.pop_front();
    return first;
  }

  void clear() {
    images_.clear();
    odometry_sec_ = attitude_sec_ = -1.0;
  }

 private:
  static constexpr std::size_t kMaxWaiting = 30;
  static constexpr double kAttitudeWaitSec = 0.05;  // in the bag's time

  bool isComplete(const Image& image, double newest_sec) const {
    const double sec = image.header.stamp.toSec();
    const bool awaits_attitude = for_attitude_ && newest_sec < sec + kAttitudeWaitSec;
    return !(for_odometry_ && odometry_sec_ < sec) && !(awaits_attitude && attitude_sec_ < sec);
  }

  bool for_odometry_, for_attitude_;
  std::deque<Image> images_;
  double odometry_sec_ = -1.0, attitude_sec_ = -1.0;
};

}  // namespace window_ingress::adapters
