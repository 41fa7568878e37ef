#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Projective map between the unit square, (0, 0) to (1, 1) in canonical order, and a convex quadrilateral.
class UnitSquare {
 public:
  explicit UnitSquare(const geometry::Quadrilateral& quad);

  /// Pixel of a point of the square's plane; far outside any image for points beyond the horizon.
  Eigen::Vector2d toImage(const Eigen::Vector2d& unit) const { return apply(map_, unit); }
  /// Point of the square's plane under a pixel.
  Eigen::Vector2d fromImage(const Eigen::Vector2d& pixel) const { return apply(inverse_, pixel); }

 private:
  static Eigen::Vector2d apply(const Eigen::Matrix3d& map, const Eigen::Vector2d& point);

  Eigen::Matrix3d map_, inverse_;
};

}  // namespace window_ingress::detection
