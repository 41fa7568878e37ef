#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

namespace window_ingress::adapters {

/// Notices images that stay the same to the last bit, as those of a stuck camera do under new stamps.
class StuckCamera {
 public:
  static constexpr double kStuckSec = 1.0;

  /// \return whether the image has been the same for longer than `kStuckSec`
  bool isStuck(const cv::Mat& image, double now_sec);

 private:
  std::uint64_t checksum_ = 0;
  double since_sec_ = -1.0;
};

}  // namespace window_ingress::adapters
