#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Closes the holes of an edge map by dilation (P6). Borders move outwards by `radiusPx`; only the search
/// sees that.
class EdgeDilation {
 public:
  explicit EdgeDilation(const ClosingParams& params) : params_(params) {}

  int radiusPx(const cv::Size& size) const;

  /// \param edges CV_8UC1. The result stays valid until the next call.
  const cv::Mat& run(const cv::Mat& edges);

 private:
  ClosingParams params_;
  cv::Mat dilated_, kernel_;
};

}  // namespace window_ingress::detection
