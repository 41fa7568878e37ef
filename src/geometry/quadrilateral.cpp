#include "window_ingress/geometry/quadrilateral.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace window_ingress::geometry {
namespace {

using Eigen::Vector2d;

/// A quadrilateral clipped four times; each clip adds at most half as many points.
struct Polygon {
  std::array<Vector2d, 20> points;
  int count = 0;

  const Vector2d& after(int i) const { return points[(i + 1) % count]; }
  void add(const Vector2d& p) { points[count++] = p; }
};

double polygonArea(const Polygon& polygon) {
  double twice = 0.0;
  for (int i = 0; i < polygon.count; ++i) twice += cross(polygon.points[i], polygon.after(i));
  return 0.5 * std::abs(twice);
}

// Sutherland-Hodgman: the part of `polygon` on the right (screen-inner) side of the line a-b.
Polygon clip(const Polygon& polygon, const Vector2d& a, const Vector2d& b) {
  Polygon kept;
  for (int i = 0; i < polygon.count; ++i) {
    const Vector2d &p = polygon.points[i], &q = polygon.after(i);
    const double dp = cross(b - a, p - a), dq = cross(b - a, q - a);
    if (dp >= 0.0) kept.add(p);
    if ((dp < 0.0) != (dq < 0.0)) kept.add(p + (q - p) * (dp / (dp - dq)));
  }
  return kept;
}

}  // namespace

bool isFinite(const Quadrilateral& quad) {
  return std::all_of(quad.begin(), quad.end(), [](const Vector2d& p) { return p.allFinite(); });
}

double signedArea(const Quadrilateral& quad) { return 0.5 * cross(quad[2] - quad[0], quad[3] - quad[1]); }

double rootArea(const Quadrilateral& quad) { return std::sqrt(std::abs(signedArea(quad))); }

bool isConvex(const Quadrilateral& quad) {
  int turns = 0;
  for (int i = 0; i < 4; ++i) {
    const double turn = cross(quad[(i + 1) % 4] - quad[i], quad[(i + 2) % 4] - quad[(i + 1) % 4]);
    turns += turn > 0.0 ? 1 : (turn < 0.0 ? -1 : 0);
  }
  return std::abs(turns) == 4;
}

std::optional<Quadrilateral> canonical(const Quadrilateral& quad) {
  if (!isFinite(quad) || !isConvex(quad)) return std::nullopt;
  Quadrilateral ordered = quad;
  if (signedArea(ordered) < 0.0) std::reverse(ordered.begin(), ordered.end());
  const auto first = std::min_element(ordered.begin(), ordered.end(),
                                      [](const Vector2d& a, const Vector2d& b) { return a.sum() < b.sum(); });
  std::rotate(ordered.begin(), first, ordered.end());
  return ordered;
}

Vector2d centroid(const Quadrilateral& quad) { return 0.25 * (quad[0] + quad[1] + quad[2] + quad[3]); }

std::array<double, 4> sideLengths(const Quadrilateral& quad) {
  std::array<double, 4> lengths{};
  for (int i = 0; i < 4; ++i) lengths[i] = (quad[(i + 1) % 4] - quad[i]).norm();
  return lengths;
}

double meanSide(const Quadrilateral& quad) {
  const auto sides = sideLengths(quad);
  return 0.25 * (sides[0] + sides[1] + sides[2] + sides[3]);
}

std::array<double, 4> interiorAngles(const Quadrilateral& quad) {
  std::array<double, 4> angles{};
  for (int i = 0; i < 4; ++i) {
    const Vector2d a = quad[(i + 3) % 4] - quad[i], b = quad[(i + 1) % 4] - quad[i];
    angles[i] = std::abs(std::atan2(cross(a, b), a.dot(b)));
  }
  return angles;
}

double aspectRatio(const Quadrilateral& quad) {
  const auto sides = sideLengths(quad);
  const double vertical = sides[kRight] + sides[kLeft];
  return vertical > 0.0 ? (sides[kTop] + sides[kBottom]) / vertical : 0.0;
}

double furthestCorner(const Quadrilateral& a, const Quadrilateral& b) {
  double furthest = 0.0;
  for (int i = 0; i < 4; ++i) furthest = std::max(furthest, (a[i] - b[i]).norm());
  return furthest;
}

bool contains(const Quadrilateral& quad, const Vector2d& point) {
  const double winding = signedArea(quad) < 0.0 ? -1.0 : 1.0;
  for (int i = 0; i < 4; ++i)
    if (winding * cross(quad[(i + 1) % 4] - quad[i], point - quad[i]) < 0.0) return false;
  return true;
}

double intersectionOverUnion(const Quadrilateral& a, const Quadrilateral& b) {
  Quadrilateral clipper = b;
  if (signedArea(clipper) < 0.0) std::reverse(clipper.begin(), clipper.end());
  Polygon overlap;
  for (const Vector2d& p : a) overlap.add(p);
  for (int i = 0; i < 4; ++i) overlap = clip(overlap, clipper[i], clipper[(i + 1) % 4]);
  const double shared = polygonArea(overlap);
  const double united = std::abs(signedArea(a)) + std::abs(signedArea(b)) - shared;
  return united > 0.0 ? shared / united : 0.0;
}

}  // namespace window_ingress::geometry
