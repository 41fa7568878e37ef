#include "detection/borders/lines.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kPasses = 8;
constexpr double kSettledPx = 1e-5;

double bisquare(double x) { return std::abs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0; }

// The points may all lie a little beside the start: weights about their median.
void firstWeights(const OffsetPoints& points, double scale_px, const OffsetLine& line) {
  double *rests = points.scratch, *sorted = points.scratch + points.count;
  for (int i = 0; i < points.count; ++i) rests[i] = points.offsets[i] - line.at(points.positions[i]);
  std::copy(rests, rests + points.count, sorted);
  std::nth_element(sorted, sorted + points.count / 2, sorted + points.count);
  const double median = sorted[points.count / 2];
  for (int i = 0; i < points.count; ++i) rests[i] = 1e-3 + bisquare((rests[i] - median) / (6.0 * scale_px));
}

// Weighted least squares; false if the weights leave nothing to solve.
bool solve(const OffsetPoints& points, OffsetLine& line) {
  double w = 0, ws = 0, wd = 0, wss = 0, wsd = 0;
  for (int i = 0; i < points.count; ++i) {
    const double weight = points.scratch[i], s = points.positions[i], d = points.offsets[i];
    w += weight, ws += weight * s, wd += weight * d, wss += weight * s * s, wsd += weight * s * d;
  }
  if (!(w > 0.0)) return false;
  const double mean = ws / w, spread = wss - ws * mean;
  if (!(spread > 1e-9 * w)) return false;
  line.slope = (wsd - wd * mean) / spread;
  line.offset = wd / w - line.slope * mean;
  return true;
}

constexpr double kMinSine = 0.1;  // of the angle between borders that meet

double varianceAt(const Line& line, const Vector2d& point) {
  const double lever = line.sigma_rad * (point - line.point).norm();
  return line.sigma_px * line.sigma_px + lever * lever;
}

// Derivative of the pixel as it came by the undistorted one.
Matrix2d slopeOf(const geometry::PinholeCamera& lens, const Vector2d& ideal) {
  Matrix2d slope;
  for (int axis = 0; axis < 2; ++axis) {
    const Vector2d h = 0.5 * Vector2d::Unit(axis);
    slope.col(axis) = lens.distort(ideal + h) - lens.distort(ideal - h);
  }
  return slope;
}

}  // namespace

void fitOffsets(const OffsetPoints& points, double scale_px, OffsetLine& line) {
  if (points.count < 2) return;
  const double reach = std::max(std::abs(points.positions[0]), std::abs(points.positions[points.count - 1]));
  firstWeights(points, scale_px, line);
  for (int pass = 0; pass < kPasses; ++pass) {
    const OffsetLine before = line;
    if (!solve(points, line)) return;
    const double moved = std::abs(line.offset - before.offset) + reach * std::abs(line.slope - before.slope);
    if (pass > 1 && moved < kSettledPx) return;
    for (int i = 0; i < points.count; ++i)
      points.scratch[i] = bisquare((points.offsets[i] - line.at(points.positions[i])) / (3.0 * scale_px));
  }
}

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
  const Matrix2d slope = slopeOf(*lens, ideal.point);
  return {lens->distort(ideal.point), slope * ideal.covariance * slope.transpose()};
}

Edge edgeThroughLens(const Line& line, const Vector2d& a, const Vector2d& b,
                     const geometry::PinholeCamera* lens) {
  Edge edge{true, line.sigma_px, line.sigma_rad, a, b};
  if (!lens) return edge;
  edge.sigma_px *= (slopeOf(*lens, line.point) * line.normal).norm();
  edge.a = lens->distort(a);
  edge.b = lens->distort(b);
  return edge;
}

}  // namespace window_ingress::detection
