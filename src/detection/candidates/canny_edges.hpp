#pragma once

#include <opencv2/core.hpp>

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
/// strongest channel. \param image CV_8UC1 or CV_8UC3, not empty \param map an earlier result, whose memory
/// is reused
EdgeMap cannyEdges(const cv::Mat& image, const CannyParams& params, EdgeMap map = {});

}  // namespace window_ingress::detection
