#include "detection/candidates/blob_masks.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

constexpr double kSigmaPx = 1.0;         ///< of the smoothing: differences between channels are noisy
constexpr double kMeanOver = 1.0 / 3.0;  ///< side of the square of the mean, in longer sides of the level

}  // namespace

void BlobMasks::take(const cv::Mat& level, int channel) {
  cv::extractChannel(level, channel_, channel);
  cv::GaussianBlur(channel_, channel_, cv::Size(), kSigmaPx, kSigmaPx, cv::BORDER_REPLICATE);
  const int side = static_cast<int>(kMeanOver * std::max(level.cols, level.rows)) | 1;
  cv::boxFilter(channel_, mean_, -1, cv::Size(side, side));
}

const cv::Mat& BlobMasks::run(Sign sign, double contrast) {
  if (sign == Sign::kAbove)
    cv::subtract(channel_, mean_, difference_);
  else
    cv::subtract(mean_, channel_, difference_);
  cv::compare(difference_, contrast, mask_, cv::CMP_GT);
  return mask_;
}

}  // namespace window_ingress::detection
