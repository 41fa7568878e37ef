#include "detection/candidates/side_support.hpp"

#include <algorithm>
#include <bitset>
#include <cmath>

#include "detection/borders/edge_profiles.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr int kReachPx = 2;  ///< greatest distance of an edge pixel from the side, on the search level [px]
const double kDirection = std::cos(0.35);  ///< of the greatest angle between gradient and the side's normal
constexpr double kBeyond = 0.2;            ///< stretch examined beyond each corner [lengths of the side]
constexpr double kCornerPx = 3.0;  ///< a rounded corner ends at this distance, on the search level [px]

constexpr double kOutlinePx = 1.5;      ///< greatest distance of an outline from a side that it follows [px]
constexpr int kParts = 16;              ///< parts of a side, at most one per pixel
constexpr double kOutlinedWorth = 0.9;  ///< worth of a side that follows an outline; 1 for a straight edge
constexpr double kBlobContrast = 4.0;   ///< assumed for such a side [grey levels per pixel]

/// The edge pixel found beside one point of a side.
struct Hit {
  double worth = 0.0;     ///< 1 on the side, less beside it, 0: none
  double strength = 0.0;  ///< gradient along the outward normal [grey levels per pixel], signed
};

/// A test for edges along one line of the undistorted level.
struct Probe {
  const EdgeMap& map;
  const geometry::PinholeCamera* lens;
  Vector2d outward;  ///< unit vector across the line
  int reach;         ///< greatest distance from the line [px]

  // Tests one pixel; worth 0 if it has no edge of this direction.
  Hit at(const Vector2d& ideal) const {
    const Vector2d p = lens ? lens->distort(ideal) : ideal;
    const int x = static_cast<int>(p.x() + 0.5), y = static_cast<int>(p.y() + 0.5);
    if (p.x() < 0.0 || p.y() < 0.0 || x >= map.edges.cols || y >= map.edges.rows || !map.edges.ptr(y)[x])
      return {};
    const Vector2d gradient(map.dx.ptr<short>(y)[x], map.dy.ptr<short>(y)[x]);
    const double along = gradient.dot(outward);
    if (along * along < kDirection * kDirection * gradient.squaredNorm()) return {};
    return {1.0, along / EdgeMap::kSobelGain};
  }
  // The nearest hit: first on the line, then alternately outside and inside.
  Hit near(const Vector2d& ideal) const {
    Hit hit = at(ideal);
    for (int offset = 1; offset <= reach && hit.worth == 0.0; ++offset) {
      hit = at(ideal + offset * outward);
      if (hit.worth == 0.0) hit = at(ideal - offset * outward);
      if (offset > 1) hit.worth *= 0.5;
    }
    return hit;
  }
};

// Part of the stretch beyond `corner` in which an edge as strong as the side's continues in the direction
// `way` (unit vector). Weaker edges, such as wall joints along a border, count by their squared ratio.
double overshoot(Probe probe, const Vector2d& corner, const Vector2d& way, double stretch_px,
                 double contrast) {
  probe.outward = {way.y(), -way.x()};
  probe.reach = 1;
  const int samples = std::clamp(static_cast<int>(stretch_px), 4, 6);
  double sum = 0.0;
  for (int i = 0; i < samples; ++i) {
    const Hit hit = probe.near(corner + (kCornerPx + stretch_px * (i + 0.5) / samples) * way);
    if (hit.worth > 0.0) sum += std::min(1.0, std::pow(hit.strength / std::max(1.0, contrast), 2));
  }
  return sum / samples;
}

SideSupport measureSide(const EdgeMap& map, const geometry::PinholeCamera* lens, const Vector2d& a,
                        const Vector2d& b) {
  SideSupport support;
  const Vector2d along = b - a;
  const double length = along.norm();
  if (length < 1.0) return support;
  const Probe probe = {map, lens, Vector2d(along.y(), -along.x()) / length, kReachPx};
  const int samples = std::clamp(static_cast<int>(length * (1.0 - 2.0 * kEndMargin)), 4, 16);
  int hits = 0;
  double strength = 0.0, worth = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double t = kEndMargin + (1.0 - 2.0 * kEndMargin) * (i + 0.5) / samples;
    const Hit hit = probe.near(a + t * along);
    hits += hit.worth > 0.0;
    worth += hit.worth;
    strength += std::abs(hit.strength);
  }
  support.fraction = worth / samples;
  support.contrast = hits ? strength / hits : 0.0;
  const double stretch_px = std::max(4.0, kBeyond * length);
  support.overshoot = 0.5 * (overshoot(probe, a, -along / length, stretch_px, support.contrast) +
                             overshoot(probe, b, along / length, stretch_px, support.contrast));
  return support;
}

SideSupport outlinedSide(const Vector2d& a, const Vector2d& b, const std::vector<cv::Point>& outline) {
  const double length = (b - a).norm();
  const Vector2d along = (b - a) / length;
  const int parts = std::clamp(static_cast<int>(length), 1, kParts);
  std::bitset<kParts> seen;
  for (std::size_t k = 0; k < outline.size(); ++k) {
    const cv::Point from = outline[k], way = outline[(k + 1) % outline.size()] - from;
    const int steps = std::max(std::abs(way.x), std::abs(way.y));
    for (int s = 0; s < steps; ++s) {
      const Vector2d point(from.x + static_cast<double>(way.x) * s / steps,
                           from.y + static_cast<double>(way.y) * s / steps);
      const double t = along.dot(point - a) / length;
      if (t >= 0.0 && t < 1.0 && std::abs(geometry::cross(along, point - a)) <= kOutlinePx)
        seen.set(static_cast<std::size_t>(t * parts));
    }
  }
  return {kOutlinedWorth * static_cast<double>(seen.count()) / parts, kBlobContrast, 0.0};
}

}  // namespace

std::array<SideSupport, 4> outlinedSides(const geometry::Quadrilateral& quad,
                                         const std::vector<cv::Point>& outline) {
  std::array<SideSupport, 4> sides;
  for (int i = 0; i < 4; ++i) sides[i] = outlinedSide(quad[i], quad[(i + 1) % 4], outline);
  return sides;
}

std::array<SideSupport, 4> measureSides(const EdgeMap& map, const geometry::PinholeCamera* lens,
                                        const geometry::Quadrilateral& quad) {
  std::array<SideSupport, 4> sides;
  for (int i = 0; i < 4; ++i) sides[i] = measureSide(map, lens, quad[i], quad[(i + 1) % 4]);
  return sides;
}

}  // namespace window_ingress::detection
