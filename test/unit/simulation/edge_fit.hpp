/// An independent measurement of a dark opening's corners in an image, for tests of the renderer.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::test {

/// Position of the step between both ends of a profile, by the area under it. Exact for an edge that is
/// averaged over each pixel. Nothing if both ends are equal.
inline std::optional<double> stepPosition(const std::vector<double>& profile) {
  const double first = profile.front(), last = profile.back();
  if (std::abs(first - last) < 40.0) return std::nullopt;
  double sum = 0.0;
  for (const double value : profile) sum += (value - last) / (first - last);
  return sum - 0.5;
}

/// Sub-pixel points of one side, searched `half_px` around the line from `a` to `b`, along rows or columns.
inline std::vector<Eigen::Vector2d> edgePoints(const cv::Mat& grey, const Eigen::Vector2d& a,
                                               const Eigen::Vector2d& b, int half_px) {
  const bool flat = std::abs(b.x() - a.x()) > std::abs(b.y() - a.y());
  const int along = flat ? 0 : 1, across = 1 - along;
  const double low = std::min(a[along], b[along]), high = std::max(a[along], b[along]),
               skip = 0.12 * (high - low);
  const int last[2] = {grey.cols - 1, grey.rows - 1};
  std::vector<Eigen::Vector2d> points;
  for (int t = static_cast<int>(std::ceil(low + skip)); t <= high - skip; ++t) {
    const double guess = a[across] + (b[across] - a[across]) * (t - a[along]) / (b[along] - a[along]);
    const int from = static_cast<int>(std::lround(guess)) - half_px, to = from + 2 * half_px;
    if (t < 0 || t > last[along] || from < 0 || to > last[across]) continue;
    std::vector<double> profile;
    for (int s = from; s <= to; ++s) profile.push_back(flat ? grey.at<uchar>(s, t) : grey.at<uchar>(t, s));
    const auto step = stepPosition(profile);
    if (!step) continue;
    Eigen::Vector2d point;
    point[along] = t;
    point[across] = from + *step;
    points.push_back(point);
  }
  return points;
}

/// Line through points by total least squares, as (normal, offset): normal . p = offset.
inline Eigen::Vector3d fitLine(const std::vector<Eigen::Vector2d>& points) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const auto& p : points) mean += p / static_cast<double>(points.size());
  Eigen::Matrix2d scatter = Eigen::Matrix2d::Zero();
  for (const auto& p : points) scatter += (p - mean) * (p - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(scatter);
  const Eigen::Vector2d normal = solver.eigenvectors().col(0);
  return {normal.x(), normal.y(), normal.dot(mean)};
}

/// Corners of the opening near `expected`; each side is fitted separately. `straighten` maps an image point
/// to an image without distortion. Nothing if a side has fewer than ten points.
template <typename Straighten>
std::optional<geometry::Quadrilateral> fitCorners(const cv::Mat& grey,
                                                  const geometry::Quadrilateral& expected, int half_px,
                                                  Straighten&& straighten) {
  std::array<Eigen::Vector3d, 4> lines;
  for (int side = 0; side < 4; ++side) {
    auto points = edgePoints(grey, expected[side], expected[(side + 1) % 4], half_px);
    if (points.size() < 10) return std::nullopt;
    for (auto& point : points) point = straighten(point);
    lines[side] = fitLine(points);
  }
  geometry::Quadrilateral corners;
  for (int i = 0; i < 4; ++i) {
    Eigen::Matrix2d normals;
    normals << lines[(i + 3) % 4].head<2>().transpose(), lines[i].head<2>().transpose();
    corners[i] = normals.inverse() * Eigen::Vector2d(lines[(i + 3) % 4].z(), lines[i].z());
  }
  return corners;
}

}  // namespace window_ingress::test
