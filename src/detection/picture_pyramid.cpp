#include "window_ingress/detection/picture_pyramid.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

constexpr int kShortestSidePx = 16;

}  // namespace

void PicturePyramid::set(const cv::Mat& image) {
  deepest_ = 0;
  while (std::min(image.cols, image.rows) >> (deepest_ + 1) >= kShortestSidePx) ++deepest_;
  if (static_cast<int>(levels_.size()) <= deepest_) levels_.resize(deepest_ + 1);
  levels_[0] = image;
  made_ = 0;
}

const cv::Mat& PicturePyramid::level(int k) {
  const int wanted = std::clamp(k, 0, deepest_);
  for (; made_ < wanted; ++made_) {
    const cv::Mat& from = levels_[made_];
    const cv::Size half(from.cols / 2, from.rows / 2);
    cv::resize(from(cv::Rect(0, 0, 2 * half.width, 2 * half.height)), levels_[made_ + 1], half, 0, 0,
               cv::INTER_AREA);
  }
  return levels_[wanted];
}

}  // namespace window_ingress::detection
