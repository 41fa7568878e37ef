#include "window_ingress/detection/track_picture.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/detection_trace.hpp"

namespace window_ingress::detection {

using geometry::Quadrilateral;

bool isPicture(const cv::Mat& image) {
  return !image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3);
}

bool isSameCalibration(const geometry::PinholeCamera& a, const geometry::PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
         a.cy == b.cy && a.distortion == b.distortion && a.model == b.model;
}

double sizeOf(const Quadrilateral& quad) { return std::sqrt(std::abs(geometry::signedArea(quad))); }

Quadrilateral undistorted(Quadrilateral quad, const geometry::PinholeCamera* lens) {
  if (lens)
    for (auto& corner : quad) corner = lens->undistort(corner);
  return quad;
}

Quadrilateral distorted(Quadrilateral quad, const geometry::PinholeCamera* lens) {
  if (lens)
    for (auto& corner : quad) corner = lens->distort(corner);
  return quad;
}

double furthestCorner(const Quadrilateral& a, const Quadrilateral& b) {
  double furthest = 0.0;
  for (int i = 0; i < 4; ++i) furthest = std::max(furthest, (a[i] - b[i]).norm());
  return furthest;
}

}  // namespace window_ingress::detection
