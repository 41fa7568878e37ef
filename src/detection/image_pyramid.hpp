#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace window_ingress::detection {

/// Half the image: each pixel is the mean of four. An odd last row or column is left out.
inline void halve(const cv::Mat& image, cv::Mat& half) {
  const cv::Size size(image.cols / 2, image.rows / 2);
  cv::resize(image(cv::Rect(0, 0, 2 * size.width, 2 * size.height)), half, size, 0, 0, cv::INTER_AREA);
}

/// An image at full, half, quarter ... size. Makes each level on first use. Keeps its memory.
class ImagePyramid {
 public:
  /// \param image CV_8UC1 or CV_8UC3; shared, not copied
  void set(const cv::Mat& image) {
    deepest_ = 0;
    while (std::min(image.cols, image.rows) >> (deepest_ + 1) >= kSmallestLevelPx) ++deepest_;
    if (static_cast<int>(levels_.size()) <= deepest_) levels_.resize(deepest_ + 1);
    levels_[0] = image;
    made_ = 0;
  }

  /// \param k 0: the image itself; clamped to the deepest level
  const cv::Mat& level(int k) {
    const int wanted = std::clamp(k, 0, deepest_);
    for (; made_ < wanted; ++made_) halve(levels_[made_], levels_[made_ + 1]);
    return levels_[wanted];
  }
  int deepest() const { return deepest_; }  ///< its shorter side has about 16 pixels

  /// Pixel of the image in coordinates of a level; pixel centres are integers on both.
  static Eigen::Vector2d onLevel(const Eigen::Vector2d& pixel, int k) {
    const double factor = 1 << k;
    return (pixel.array() - 0.5 * (factor - 1.0)) / factor;
  }

 private:
  static constexpr int kSmallestLevelPx = 16;

  std::vector<cv::Mat> levels_;
  int made_ = 0, deepest_ = 0;
};

}  // namespace window_ingress::detection
