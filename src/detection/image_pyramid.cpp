#include "detection/image_pyramid.hpp"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {
namespace {

constexpr int kSmallestLevelPx = 16;

}  // namespace

void halve(const cv::Mat& image, cv::Mat& half) {
  const cv::Size size(image.cols / 2, image.rows / 2);
  cv::resize(image(cv::Rect(0, 0, 2 * size.width, 2 * size.height)), half, size, 0, 0, cv::INTER_AREA);
}

void ImagePyramid::set(const cv::Mat& image) {
  deepest_ = 0;
  while (std::min(image.cols, image.rows) >> (deepest_ + 1) >= kSmallestLevelPx) ++deepest_;
  if (static_cast<int>(levels_.size()) <= deepest_) levels_.resize(deepest_ + 1);
  levels_[0] = image;
  made_ = 0;
}

const cv::Mat& ImagePyramid::level(int k) {
  const int wanted = std::clamp(k, 0, deepest_);
  for (; made_ < wanted; ++made_) halve(levels_[made_], levels_[made_ + 1]);
  return levels_[wanted];
}

}  // namespace window_ingress::detection
