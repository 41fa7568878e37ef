#pragma once

#include <std_msgs/Header.h>

#include <deque>
#include <functional>
#include <optional>

#include "adapters/images/image_conversion.hpp"

namespace window_ingress::adapters {

/// Images of a bag, in their order, each until what belongs to its exposure has come: odometry as new as
/// itself; for the attitude an image does not wait for ever, which may have stopped.
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

  /// The first, if it waits for nothing more. \param newest_sec the newest stamp of all that has come
  std::optional<Image> takeComplete(double newest_sec);
  std::optional<Image> take();  ///< the first, whatever it waits for
  void clear();

 private:
  bool isComplete(const Image& image, double newest_sec) const;

  bool for_odometry_, for_attitude_;
  std::deque<Image> images_;
  double odometry_sec_ = -1.0, attitude_sec_ = -1.0;
};

}  // namespace window_ingress::adapters
