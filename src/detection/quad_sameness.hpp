#pragma once

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Compares other quadrilaterals with one, in the three senses of sameness that detection uses. Tolerances
/// follow from its size. Construct it from the quadrilateral chosen first, or a large loop takes a small
/// window's place.
class Sameness {
 public:
  explicit Sameness(const geometry::Quadrilateral& quad) : quad_(quad), size_px_(geometry::rootArea(quad)) {}

  /// The same four edges: every corner within 1 px and 0.005 of its size.
  bool sameQuad(const geometry::Quadrilateral& other) const {
    return isWithin(other, 1.0 + 0.005 * size_px_);
  }
  /// Edges of the same window, for example both borders of its frame: every corner within 0.2 of its size.
  bool samePlace(const geometry::Quadrilateral& other) const { return isWithin(other, 0.2 * size_px_); }
  /// The same window: the intersection is more than 0.6 of the union.
  bool sameWindow(const geometry::Quadrilateral& other) const {
    return geometry::intersectionOverUnion(quad_, other) > 0.6;
  }

 private:
  bool isWithin(const geometry::Quadrilateral& other, double limit_px) const {
    for (int i = 0; i < 4; ++i)
      if ((other[i] - quad_[i]).squaredNorm() > limit_px * limit_px) return false;
    return true;
  }

  geometry::Quadrilateral quad_;
  double size_px_;
};

}  // namespace window_ingress::detection
