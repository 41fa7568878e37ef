#include "window_ingress/detection/robust_line.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr int kPasses = 6;

double bisquare(double x) { return std::abs(x) < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0; }

// The points may all lie a little beside the start: weights about their median.
std::vector<double> firstWeights(const std::vector<Vector2d>& points, double scale_px, const Line& line) {
  std::vector<double> distances(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) distances[i] = line.distance(points[i]);
  std::vector<double> sorted = distances;
  std::nth_element(sorted.begin(), sorted.begin() + sorted.size() / 2, sorted.end());
  const double median = sorted[sorted.size() / 2];
  for (double& value : distances) value = 1e-3 + bisquare((value - median) / (6.0 * scale_px));
  return distances;
}

void solve(const std::vector<Vector2d>& points, const std::vector<double>& weights, Line& line) {
  double sum = 0.0;
  Vector2d mean = Vector2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i) sum += weights[i], mean += weights[i] * points[i];
  if (sum <= 0.0) return;
  mean /= sum;
  Matrix2d scatter = Matrix2d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
    scatter += weights[i] * (points[i] - mean) * (points[i] - mean).transpose();
  Vector2d normal = Eigen::SelfAdjointEigenSolver<Matrix2d>(scatter).eigenvectors().col(0);
  if (normal.dot(line.normal) < 0.0) normal = -normal;
  line.point += normal * normal.dot(mean - line.point);
  line.normal = normal;
}

}  // namespace

void fitRobustLine(const std::vector<Vector2d>& points, double scale_px, Line& line) {
  if (points.size() < 2) return;
  std::vector<double> weights = firstWeights(points, scale_px, line);
  for (int pass = 0; pass < kPasses; ++pass) {
    solve(points, weights, line);
    for (std::size_t i = 0; i < points.size(); ++i)
      weights[i] = bisquare(line.distance(points[i]) / (3.0 * scale_px));
  }
}

LineSpread spreadAbout(const Line& line, const std::vector<Vector2d>& points, double scale_px) {
  LineSpread spread;
  for (const Vector2d& point : points) {
    const double distance = line.distance(point);
    if (std::abs(distance) > 2.0 * scale_px) continue;
    ++spread.inliers;
    spread.sum_of_squares += distance * distance;
  }
  return spread;
}

}  // namespace window_ingress::detection
