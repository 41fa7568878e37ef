#include "detection/borders/lines.hpp"

#include <Eigen/LU>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kMinSine = 0.1;  // of the angle between borders that meet

double varianceAt(const Line& line, const Vector2d& point) {
  const double lever = line.sigma_rad * (point - line.point).norm();
  return line.sigma_px * line.sigma_px + lever * lever;
}

}  // namespace

std::optional<LineCorner> meet(const Line& a, const Line& b) {
  Matrix2d normals;
  normals << a.normal.transpose(), b.normal.transpose();
  if (!(std::abs(normals.determinant()) > kMinSine)) return std::nullopt;
  const Matrix2d inverse = normals.inverse();
  LineCorner corner;
  corner.point = inverse * Vector2d(a.normal.dot(a.point), b.normal.dot(b.point));
  Matrix2d spread = Matrix2d::Zero();
  spread.diagonal() << varianceAt(a, corner.point), varianceAt(b, corner.point);
  corner.covariance = inverse * spread * inverse.transpose();
  return corner;
}

LineCorner throughLens(const LineCorner& ideal, const geometry::PinholeCamera* lens) {
  if (!lens) return ideal;
  const Matrix2d slope = lens->distortionSlope(ideal.point);
  return {lens->distort(ideal.point), slope * ideal.covariance * slope.transpose()};
}

Edge edgeThroughLens(const Line& line, const Vector2d& a, const Vector2d& b,
                     const geometry::PinholeCamera* lens) {
  Edge edge{true, line.sigma_px, line.sigma_rad, a, b};
  if (!lens) return edge;
  edge.sigma_px /= lens->pixelAcross(line.point, b - a);
  edge.a = lens->distort(a);
  edge.b = lens->distort(b);
  return edge;
}

}  // namespace window_ingress::detection
