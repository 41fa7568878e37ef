#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Thin edges of an image with the gradient under them.
struct EdgeMap {
  /// `dx` and `dy` are Sobel sums: this many times the gradient in grey levels per pixel.
  static constexpr double kSobelGain = 8.0;

  cv::Mat edges;   ///< CV_8UC1, 0 or 255, one pixel wide
  cv::Mat dx, dy;  ///< CV_16SC1, of the channel with the strongest gradient at that pixel
};

/// Canny (P3) with thresholds that adapt to the image. For colour images the gradient is that of the
/// strongest channel.
class CannyEdges {
 public:
  explicit CannyEdges(const CannyParams& params) : params_(params) {}

  /// \param image CV_8UC1 or CV_8UC3, not empty. The result stays valid until the next call.
  const EdgeMap& run(const cv::Mat& image);

 private:
  void gradient(const cv::Mat& image);
  void measureStrength();
  double upperThreshold() const;
  void thin();
  void followStrong();

  CannyParams params_;
  EdgeMap map_;
  cv::Mat all_dx_, all_dy_;  ///< CV_16SC3, per channel
  cv::Mat strength_;         ///< CV_16SC1, |dx| + |dy|
  std::vector<uchar*> waiting_;
};

}  // namespace window_ingress::detection
