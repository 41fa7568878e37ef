#include "window_ingress/detection/side_support.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

using Eigen::Vector2d;

constexpr double kCornerPx = 3.0;  ///< a rounded corner ends this far out on the search level

/// The edge pixel found beside one point of a side.
struct Hit {
  double worth = 0.0;     ///< 1 on the side, less beside it, 0: none
  double strength = 0.0;  ///< gradient along the side's outward normal [grey levels a pixel], signed
};

Hit hitNear(const EdgeMap& map, const Vector2d& at, const Vector2d& outward, int reach, double min_cosine) {
  for (int k = 0; k <= 2 * reach; ++k) {
    const int offset = (k + 1) / 2 * (k % 2 ? 1 : -1);
    const Vector2d p = at + offset * outward;
    const int x = static_cast<int>(p.x() + 0.5), y = static_cast<int>(p.y() + 0.5);
    if (p.x() < 0.0 || p.y() < 0.0 || x < 0 || y < 0 || x >= map.edges.cols || y >= map.edges.rows ||
        !map.edges.at<uchar>(y, x))
      continue;
    const Vector2d gradient(map.dx.at<short>(y, x), map.dy.at<short>(y, x));
    const double along = gradient.dot(outward);
    if (std::abs(along) >= min_cosine * gradient.norm())
      return {std::abs(offset) <= 1 ? 1.0 : 0.5, along / EdgeMap::kSobelGain};
  }
  return {};
}

// Part of the stretch beyond `corner` where an edge goes on in the direction `way` (unit vector).
double overshoot(const EdgeMap& map, const Vector2d& corner, const Vector2d& way, double stretch_px,
                 double min_cosine) {
  const Vector2d across(way.y(), -way.x());
  const int samples = std::clamp(static_cast<int>(stretch_px), 4, 10);
  int hits = 0;
  for (int i = 0; i < samples; ++i) {
    const double distance = kCornerPx + stretch_px * (i + 0.5) / samples;
    hits += hitNear(map, corner + distance * way, across, 1, min_cosine).worth > 0.0;
  }
  return static_cast<double>(hits) / samples;
}

SideSupport measureSide(const EdgeMap& map, const Vector2d& a, const Vector2d& b,
                        const SideSupportParams& params) {
  SideSupport support;
  const Vector2d along = b - a;
  const double length = along.norm();
  if (length < 1.0) return support;
  const Vector2d outward = Vector2d(along.y(), -along.x()) / length;
  const int samples = std::clamp(static_cast<int>(length * (1.0 - 2.0 * params.skip)), 4, 40);
  const int reach = static_cast<int>(std::lround(params.tolerance_px));
  const double min_cosine = std::cos(params.direction_rad);
  int hits = 0, darker_outside = 0;
  double strength = 0.0, worth = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double t = params.skip + (1.0 - 2.0 * params.skip) * (i + 0.5) / samples;
    const Hit hit = hitNear(map, a + t * along, outward, reach, min_cosine);
    if (hit.worth <= 0.0) continue;
    ++hits;
    worth += hit.worth;
    strength += std::abs(hit.strength);
    darker_outside += hit.strength < 0.0;
  }
  support.fraction = worth / samples;
  support.contrast = hits ? strength / hits : 0.0;
  const double stretch_px = std::max(4.0, params.beyond * length);
  support.overshoot = 0.5 * (overshoot(map, a, -along / length, stretch_px, min_cosine) +
                             overshoot(map, b, along / length, stretch_px, min_cosine));
  support.polarity = hits ? 2.0 * darker_outside / hits - 1.0 : 0.0;
  return support;
}

}  // namespace

std::array<SideSupport, 4> measureSides(const EdgeMap& map, const geometry::Quadrilateral& quad,
                                        const SideSupportParams& params) {
  std::array<SideSupport, 4> sides;
  for (int i = 0; i < 4; ++i) sides[i] = measureSide(map, quad[i], quad[(i + 1) % 4], params);
  return sides;
}

}  // namespace window_ingress::detection
