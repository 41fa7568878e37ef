#pragma once

#include <Eigen/Core>
#include <Eigen/LU>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::geometry {

/// Projective map between the unit square, (0, 0) to (1, 1) in canonical order, and a convex quadrilateral.
class UnitSquare {
 public:
  explicit UnitSquare(const Quadrilateral& q) {
    const Eigen::Vector2d s = q[0] - q[1] + q[2] - q[3], d1 = q[1] - q[2], d2 = q[3] - q[2];
    const double det = d1.x() * d2.y() - d2.x() * d1.y();
    const double g = (s.x() * d2.y() - d2.x() * s.y()) / det, h = (d1.x() * s.y() - s.x() * d1.y()) / det;
    map_ << q[1].x() - q[0].x() + g * q[1].x(), q[3].x() - q[0].x() + h * q[3].x(), q[0].x(),
        q[1].y() - q[0].y() + g * q[1].y(), q[3].y() - q[0].y() + h * q[3].y(), q[0].y(), g, h, 1.0;
    inverse_ = map_.inverse();
    inverse_ /= inverse_(2, 2);
  }

  /// Pixel of a point of the square's plane; far outside any image for points beyond the horizon.
  Eigen::Vector2d toImage(const Eigen::Vector2d& unit) const { return apply(map_, unit); }
  /// The map to the image in homogeneous coordinates; the third coordinate is positive on this side of the
  /// horizon.
  const Eigen::Matrix3d& matrix() const { return map_; }
  /// Point of the square's plane under a pixel.
  Eigen::Vector2d fromImage(const Eigen::Vector2d& pixel) const { return apply(inverse_, pixel); }

 private:
  static Eigen::Vector2d apply(const Eigen::Matrix3d& map, const Eigen::Vector2d& point) {
    const double depth = map(2, 0) * point.x() + (map(2, 1) * point.y() + map(2, 2));
    if (!(depth > 1e-6)) return {-1e6, -1e6};
    return (map.col(0).head<2>() * point.x() + map.col(1).head<2>() * point.y() + map.col(2).head<2>()) /
           depth;
  }

  Eigen::Matrix3d map_, inverse_;
};

}  // namespace window_ingress::geometry
