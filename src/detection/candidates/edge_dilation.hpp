#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Closes gaps of an edge map by dilation (P6). Borders move outwards by `radiusPx`; this affects only the
/// search.
class EdgeDilation {
 public:
  explicit EdgeDilation(const DilationParams& params) : params_(params) {}

  int radiusPx(const cv::Size& size) const {
    return std::max(1, static_cast<int>(std::lround(params_.radius * std::max(size.width, size.height))));
  }

  /// \param edges CV_8UC1. The result stays valid until the next call.
  const cv::Mat& run(const cv::Mat& edges) {
    const int side = 2 * radiusPx(edges.size()) + 1;
    if (kernel_.rows != side) kernel_ = cv::getStructuringElement(cv::MORPH_RECT, {side, side});
    cv::dilate(edges, dilated_, kernel_);
    return dilated_;
  }

 private:
  DilationParams params_;
  cv::Mat dilated_, kernel_;
};

}  // namespace window_ingress::detection
