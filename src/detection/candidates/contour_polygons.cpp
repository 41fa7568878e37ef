#include "detection/candidates/contour_polygons.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "detection/candidates/side_support.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kMinPerimeter = 0.08;  ///< of an outline, in longer sides of the level
constexpr double kHullExcess = 0.12;    ///< the four lines round a hull may add this part of the hull's area
constexpr double kClosure = 0.7;        ///< of an outline, which is closed but has imprecise corners
constexpr int kMaxContours = 3000;      ///< number of outlines examined per image

// Point where the sides before `a` and after `b` meet if side a-b is removed, and the area that this adds.
bool meetBeyond(const Vector2d& before, const Vector2d& a, const Vector2d& b, const Vector2d& after,
                Vector2d& meet, double& added) {
  const Vector2d u = a - before, v = after - b;
  const double sine = geometry::cross(u, v);
  if (std::abs(sine) < 1e-6 * u.norm() * v.norm()) return false;
  const double s = geometry::cross(b - a, v) / sine, t = geometry::cross(b - a, u) / sine;
  if (s < 0.0 || t > 0.0) return false;
  meet = a + s * u;
  added = 0.5 * std::abs(geometry::cross(b - a, meet - a));
  return true;
}

bool removeCheapestSide(std::vector<Vector2d>& polygon) {
  const std::size_t n = polygon.size();
  double least = std::numeric_limits<double>::infinity();
  std::size_t side = n;
  Vector2d corner = Vector2d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    Vector2d meet = Vector2d::Zero();
    double added = 0.0;
    if (!meetBeyond(polygon[(i + n - 1) % n], polygon[i], polygon[(i + 1) % n], polygon[(i + 2) % n], meet,
                    added))
      continue;
    if (added < least) least = added, side = i, corner = meet;
  }
  if (side == n) return false;
  polygon[side] = corner;
  polygon.erase(polygon.begin() + (side + 1) % n);
  return true;
}

geometry::Quadrilateral toQuad(const std::vector<cv::Point>& p) {
  return {Vector2d(p[0].x, p[0].y), Vector2d(p[1].x, p[1].y), Vector2d(p[2].x, p[2].y),
          Vector2d(p[3].x, p[3].y)};
}

// Moves each side outwards.
geometry::Quadrilateral grown(const geometry::Quadrilateral& quad, double distance_px) {
  geometry::Quadrilateral result;
  for (int i = 0; i < 4; ++i) {
    const Vector2d before = (quad[i] - quad[(i + 3) % 4]).normalized();
    const Vector2d after = (quad[(i + 1) % 4] - quad[i]).normalized();
    result[i] = quad[i] + (before - after) * (distance_px / geometry::cross(before, after));
  }
  return result;
}

geometry::Quadrilateral boundingQuad(const std::vector<cv::Point>& outline) {
  const cv::Rect box = cv::boundingRect(outline);
  const Vector2d a(box.x, box.y), b(box.x + box.width - 1, box.y + box.height - 1);
  return {a, Vector2d(b.x(), a.y()), b, Vector2d(a.x(), b.y())};
}

}  // namespace

std::optional<geometry::Quadrilateral> quadRoundHull(const std::vector<cv::Point>& hull,
                                                     std::vector<Vector2d>& buffer) {
  if (hull.size() < 4) return std::nullopt;
  std::vector<Vector2d>& polygon = buffer;
  polygon.clear();
  for (const cv::Point& p : hull) polygon.emplace_back(p.x, p.y);
  while (polygon.size() > 4)
    if (!removeCheapestSide(polygon)) return std::nullopt;
  return geometry::canonical({polygon[0], polygon[1], polygon[2], polygon[3]});
}

void ContourPolygons::look(const std::vector<cv::Point>& outline, double min_perimeter_px, double grow_px) {
  const double perimeter = cv::arcLength(outline, true);
  if (outline.size() < 4 || perimeter < min_perimeter_px) return;
  cv::convexHull(outline, hull_);
  const double hull_area = cv::contourArea(hull_);
  if (hull_area < 0.01 * min_perimeter_px * min_perimeter_px) return;
  Candidate candidate;
  candidate.solidity = cv::contourArea(outline) / hull_area;
  cv::approxPolyDP(hull_, polygon_, params_.epsilon * cv::arcLength(hull_, true), true);
  std::optional<geometry::Quadrilateral> quad;
  if (polygon_.size() == 4) quad = geometry::canonical(toQuad(polygon_));
  if (!quad && hull_.size() <= 200) quad = quadRoundHull(hull_, lines_);
  const double excess = quad ? geometry::signedArea(*quad) / hull_area - 1.0 : 1.0;
  if (excess > kHullExcess) {
    result_.rejected.push_back({boundingQuad(outline), source_, RejectReason::kCorners,
                                static_cast<double>(polygon_.size()), 4.0, 0.0, false, 0.0, 0.0, 0.0});
    return;
  }
  candidate.source = source_;
  if (source_ == CandidateSource::kBlob) candidate.sides = outlinedSides(*quad, outline);
  candidate.closure = kClosure;
  candidate.quad = candidate.seen = grown(*quad, grow_px);
  result_.candidates.push_back(candidate);
}

const ContourPolygons::Result& ContourPolygons::run(const cv::Mat& closed, double dilation_px,
                                                    CandidateSource source) {
  source_ = source;
  result_.candidates.clear();
  result_.rejected.clear();
  cv::findContours(closed, outlines_, tree_, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  result_.contours = static_cast<int>(outlines_.size());
  result_.budget_exceeded = result_.contours > kMaxContours;
  const int count = std::min(result_.contours, kMaxContours);
  const double min_perimeter_px = kMinPerimeter * std::max(closed.cols, closed.rows);
  for (int i = 0; i < count; ++i) {
    const bool is_hole = tree_[i][3] >= 0;
    look(outlines_[i], min_perimeter_px, is_hole ? dilation_px : -dilation_px);
  }
  return result_;
}

}  // namespace window_ingress::detection
