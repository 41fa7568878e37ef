#pragma once

#include <opencv2/core.hpp>

namespace window_ingress::detection {

/// Regions of one channel that stand out from what surrounds them, however weak or broken their edges are.
class BlobMasks {
 public:
  enum class Sign { kAbove, kBelow };

  /// The channel in which `run` looks. \param level CV_8UC1 or CV_8UC3
  void take(const cv::Mat& level, int channel);

  /// Where the channel is above, or below, its mean over the square around by more than `contrast`: CV_8UC1,
  /// 0 or 255. Valid until the next call. \param contrast [grey levels]
  const cv::Mat& run(Sign sign, double contrast);

 private:
  cv::Mat channel_, mean_, difference_, mask_;
};

}  // namespace window_ingress::detection
