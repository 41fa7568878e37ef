#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::geometry {

/// True if the pixel lies in an image of this size, at least `margin_px` inside its border.
inline bool isInside(const Eigen::Vector2d& pixel, int width, int height, double margin_px = 0.0) {
  return pixel.x() >= margin_px && pixel.y() >= margin_px && pixel.x() <= width - 1 - margin_px &&
         pixel.y() <= height - 1 - margin_px;
}

/// Distance of a pixel from the border of an image of this size, negative outside [px].
inline double distanceToBorder(const Eigen::Vector2d& pixel, int width, int height) {
  return std::min({pixel.x(), pixel.y(), width - 1 - pixel.x(), height - 1 - pixel.y()});
}

/// Distance of the outermost corner from the border of an image of this size, negative outside [px].
inline double distanceToBorder(const Quadrilateral& quad, int width, int height) {
  double least = std::max(width, height);
  for (const Eigen::Vector2d& corner : quad) least = std::min(least, distanceToBorder(corner, width, height));
  return least;
}

}  // namespace window_ingress::geometry
