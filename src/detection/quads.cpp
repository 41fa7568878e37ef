#include "detection/quads.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kSameQuadPx = 1.0, kSameQuad = 0.005;  ///< distance of corners [px], [sizes]
constexpr double kSamePlace = 0.2;                      ///< distance of corners [sizes]
constexpr double kSameWindow = 0.6;                     ///< intersection over union

}  // namespace

double sizeOf(const Quadrilateral& quad) { return std::sqrt(std::abs(geometry::signedArea(quad))); }

double meanSide(const Quadrilateral& quad) {
  const auto sides = geometry::sideLengths(quad);
  return 0.25 * (sides[0] + sides[1] + sides[2] + sides[3]);
}

double furthestCorner(const Quadrilateral& a, const Quadrilateral& b) {
  double furthest = 0.0;
  for (int i = 0; i < 4; ++i) furthest = std::max(furthest, (a[i] - b[i]).norm());
  return furthest;
}

double distanceToBorder(const Quadrilateral& quad, const cv::Size& image) {
  double least = std::max(image.width, image.height);
  for (const Eigen::Vector2d& p : quad)
    least = std::min({least, p.x(), p.y(), image.width - 1 - p.x(), image.height - 1 - p.y()});
  return least;
}

const geometry::PinholeCamera* lensOf(const geometry::PinholeCamera* camera) {
  return camera && camera->hasDistortion() ? camera : nullptr;
}

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

Sameness::Sameness(const Quadrilateral& quad)
    : quad_(quad), same_px_(kSameQuadPx + kSameQuad * sizeOf(quad)), place_px_(kSamePlace * sizeOf(quad)) {}

bool Sameness::sameWindow(const Quadrilateral& other) const {
  return geometry::intersectionOverUnion(quad_, other) > kSameWindow;
}

}  // namespace window_ingress::detection
