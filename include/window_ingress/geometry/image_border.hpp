#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::geometry {

/// Distance of the outermost corner from the border of an image of this size, negative outside [px].
inline double distanceToBorder(const Quadrilateral& quad, int width, int height) {
  double least = std::max(width, height);
  for (const Eigen::Vector2d& p : quad)
    least = std::min({least, p.x(), p.y(), width - 1 - p.x(), height - 1 - p.y()});
  return least;
}

}  // namespace window_ingress::geometry
