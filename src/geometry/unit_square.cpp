#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::geometry {

UnitSquare::UnitSquare(const Quadrilateral& q) {
  const Eigen::Vector2d s = q[0] - q[1] + q[2] - q[3], d1 = q[1] - q[2], d2 = q[3] - q[2];
  const double det = d1.x() * d2.y() - d2.x() * d1.y();
  const double g = (s.x() * d2.y() - d2.x() * s.y()) / det, h = (d1.x() * s.y() - s.x() * d1.y()) / det;
  map_ << q[1].x() - q[0].x() + g * q[1].x(), q[3].x() - q[0].x() + h * q[3].x(), q[0].x(),
      q[1].y() - q[0].y() + g * q[1].y(), q[3].y() - q[0].y() + h * q[3].y(), q[0].y(), g, h, 1.0;
  inverse_ = map_.inverse();
  inverse_ /= inverse_(2, 2);
}

}  // namespace window_ingress::geometry
