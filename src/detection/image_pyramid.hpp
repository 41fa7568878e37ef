#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace window_ingress::detection {

/// Half the image: each pixel is the mean of four. An odd last row or column is left out.
void halve(const cv::Mat& image, cv::Mat& half);

/// An image at full, half, quarter ... size. Makes each level on first use. Keeps its memory.
class ImagePyramid {
 public:
  /// \param image CV_8UC1 or CV_8UC3; shared, not copied
  void set(const cv::Mat& image);

  /// \param k 0: the image itself; clamped to the deepest level
  const cv::Mat& level(int k);
  int deepest() const { return deepest_; }  ///< its shorter side has about 16 pixels

  /// Pixel of the image in coordinates of a level; pixel centres are integers on both.
  static Eigen::Vector2d onLevel(const Eigen::Vector2d& pixel, int k) {
    const double factor = 1 << k;
    return (pixel.array() - 0.5 * (factor - 1.0)) / factor;
  }

 private:
  std::vector<cv::Mat> levels_;
  int made_ = 0, deepest_ = 0;
};

}  // namespace window_ingress::detection
