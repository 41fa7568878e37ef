#include "detection/borders/lines.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr double kMinSine = 0.1;  // of the angle between borders that meet
constexpr int kRobustPasses = 8;
constexpr double kSettledPx = 1e-5;

double varianceAt(const Line& line, const Vector2d& point) {
  const double lever = line.sigma_rad * (point - line.point).norm();
  return line.sigma_px * line.sigma_px + lever * lever;
}

double bisquare(double x) { return std::abs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0; }

using Weights = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMostPoints, 1>;  // on the stack

// Weighted least squares; false if the weights leave nothing to solve.
bool solveLine(const std::vector<double>& positions, const std::vector<double>& offsets,
               const Weights& weights, OffsetLine& line) {
  double w = 0, ws = 0, wd = 0, wss = 0, wsd = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const double weight = weights[static_cast<Eigen::Index>(i)], s = positions[i], d = offsets[i];
    w += weight, ws += weight * s, wd += weight * d, wss += weight * s * s, wsd += weight * s * d;
  }
  if (!(w > 0.0)) return false;
  const double mean = ws / w, spread = wss - ws * mean;
  if (!(spread > 1e-9 * w)) return false;
  line.slope = (wsd - wd * mean) / spread;
  line.offset = wd / w - line.slope * mean;
  return true;
}

}  // namespace

void fitRobustLine(const std::vector<double>& positions, const std::vector<double>& offsets, double scale_px,
                   OffsetLine& line) {
  if (positions.size() < 2 || positions.size() > std::size_t{kMostPoints}) return;
  const auto size = static_cast<Eigen::Index>(positions.size());
  const Eigen::Map<const Eigen::ArrayXd> s(positions.data(), size), d(offsets.data(), size);
  const double reach = std::max(std::abs(positions.front()), std::abs(positions.back()));
  // The first weights are about the points' median, because all points may lie a little off the start.
  Weights weights = d - (line.offset + line.slope * s), sorted = weights;
  std::nth_element(sorted.data(), sorted.data() + size / 2, sorted.data() + size);
  weights = ((weights - sorted[size / 2]) / (6.0 * scale_px)).unaryExpr(&bisquare) + 1e-3;
  for (int pass = 0; pass < kRobustPasses; ++pass) {
    const OffsetLine before = line;
    if (!solveLine(positions, offsets, weights, line)) return;
    const double moved = std::abs(line.offset - before.offset) + reach * std::abs(line.slope - before.slope);
    if (pass > 1 && moved < kSettledPx) return;
    weights = ((d - (line.offset + line.slope * s)) / (3.0 * scale_px)).unaryExpr(&bisquare);
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
