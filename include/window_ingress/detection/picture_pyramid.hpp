#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <vector>

namespace window_ingress::detection {

/// A picture at full, half, quarter ... size; each level is made when it is first asked for. Keeps its
/// memory.
class PicturePyramid {
 public:
  /// \param image CV_8UC1 or CV_8UC3; shared, not copied
  void set(const cv::Mat& image);

  /// \param k 0: the picture itself; clamped to what is left of it
  const cv::Mat& level(int k);
  int deepest() const { return deepest_; }  ///< level of which the shorter side has 16 pixels or so

  /// Pixel of a level under a pixel of the picture: pixel centres are integers on both.
  static Eigen::Vector2d onLevel(const Eigen::Vector2d& pixel, int k) {
    const double factor = 1 << k;
    return (pixel.array() - 0.5 * (factor - 1.0)) / factor;
  }

 private:
  std::vector<cv::Mat> levels_;
  int made_ = 0, deepest_ = 0;
};

}  // namespace window_ingress::detection
