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
constexpr int kMaxContours = 3000;      ///< number of outlines examined per mask
constexpr std::size_t kMaxHull = 200;   ///< corners of a hull round which four lines are sought

// Point where the sides before `a` and after `b` meet if side a-b is removed.
std::optional<Vector2d> meetBeyond(const Vector2d& before, const Vector2d& a, const Vector2d& b,
                                   const Vector2d& after) {
  const Vector2d u = a - before, v = after - b;
  const double sine = geometry::cross(u, v);
  if (std::abs(sine) < 1e-6 * u.norm() * v.norm()) return std::nullopt;
  const double s = geometry::cross(b - a, v) / sine, t = geometry::cross(b - a, u) / sine;
  if (s < 0.0 || t > 0.0) return std::nullopt;
  return Vector2d(a + s * u);
}

bool removeCheapestSide(std::vector<Vector2d>& polygon) {
  const std::size_t n = polygon.size();
  double least = std::numeric_limits<double>::infinity();
  std::size_t side = n;
  Vector2d corner = Vector2d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector2d &a = polygon[i], &b = polygon[(i + 1) % n];
    const auto meet = meetBeyond(polygon[(i + n - 1) % n], a, b, polygon[(i + 2) % n]);
    if (!meet) continue;
    const double added = std::abs(geometry::cross(b - a, *meet - a));  // twice the area
    if (added < least) least = added, side = i, corner = *meet;
  }
  if (side == n) return false;
  polygon[side] = corner;
  polygon.erase(polygon.begin() + (side + 1) % n);
  return true;
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

int closeGaps(const cv::Mat& edges, const DilationParams& params, cv::Mat& closed) {
  const double radius_px = params.radius * std::max(edges.cols, edges.rows);
  const int whole_px = std::max(1, static_cast<int>(std::lround(radius_px))), side_px = 2 * whole_px + 1;
  cv::dilate(edges, closed, cv::getStructuringElement(cv::MORPH_RECT, {side_px, side_px}));
  return whole_px;
}

std::optional<geometry::Quadrilateral> quadRoundHull(const std::vector<cv::Point>& hull) {
  thread_local std::vector<Vector2d> polygon;
  polygon.clear();
  for (const cv::Point& p : hull) polygon.emplace_back(p.x, p.y);
  while (polygon.size() > 4)
    if (!removeCheapestSide(polygon)) return std::nullopt;
  if (polygon.size() < 4) return std::nullopt;
  return geometry::canonical({polygon[0], polygon[1], polygon[2], polygon[3]});
}

void addOutlines(const cv::Mat& closed, int dilation_px, const ContourPolygonsParams& params,
                 CandidateSource source, Outlines& outlines) {
  thread_local std::vector<std::vector<cv::Point>> contours;
  thread_local std::vector<cv::Vec4i> tree;
  cv::findContours(closed, contours, tree, cv::RETR_CCOMP, cv::CHAIN_APPROX_SIMPLE);
  const int found = static_cast<int>(contours.size());
  outlines.contours += found;
  outlines.budget_exceeded = outlines.budget_exceeded || found > kMaxContours;
  const double min_perimeter_px = kMinPerimeter * std::max(closed.cols, closed.rows);
  thread_local std::vector<cv::Point> hull, polygon;
  for (int i = 0; i < std::min(found, kMaxContours); ++i) {
    const std::vector<cv::Point>& outline = contours[i];
    if (outline.size() < 4 || cv::arcLength(outline, true) < min_perimeter_px) continue;
    cv::convexHull(outline, hull);
    const double hull_area = cv::contourArea(hull);
    if (hull_area < 0.01 * min_perimeter_px * min_perimeter_px) continue;
    cv::approxPolyDP(hull, polygon, params.epsilon * cv::arcLength(hull, true), true);
    auto quad = polygon.size() == 4 ? quadRoundHull(polygon) : std::nullopt;
    if (!quad && hull.size() <= kMaxHull) quad = quadRoundHull(hull);
    if (!quad || geometry::signedArea(*quad) / hull_area - 1.0 > kHullExcess) {
      outlines.rejected.push_back(
          {boundingQuad(outline), source, RejectReason::kCorners, static_cast<double>(polygon.size()), 4.0});
      continue;
    }
    const bool is_hole = tree[i][3] >= 0;
    Candidate& candidate = outlines.candidates.emplace_back();
    candidate.quad = candidate.seen = grown(*quad, is_hole ? dilation_px : -dilation_px);
    candidate.source = source;
    candidate.solidity = cv::contourArea(outline) / hull_area;
    candidate.closure = kClosure;
    if (source == CandidateSource::kBlob) candidate.sides = outlinedSides(*quad, outline);
  }
}

}  // namespace window_ingress::detection
