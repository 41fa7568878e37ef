#include "detection/candidates/edge_dilation.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace window_ingress::detection {

int EdgeDilation::radiusPx(const cv::Size& size) const {
  return std::max(1, static_cast<int>(std::lround(params_.radius * std::max(size.width, size.height))));
}

const cv::Mat& EdgeDilation::run(const cv::Mat& edges) {
  const int side = 2 * radiusPx(edges.size()) + 1;
  if (kernel_.rows != side) kernel_ = cv::getStructuringElement(cv::MORPH_RECT, cv::Size(side, side));
  cv::dilate(edges, dilated_, kernel_);
  return dilated_;
}

}  // namespace window_ingress::detection
