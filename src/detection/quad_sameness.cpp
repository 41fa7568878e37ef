#include "detection/quad_sameness.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kSameQuadPx = 1.0, kSameQuad = 0.005;  ///< distance of corners [px], [sizes]
constexpr double kSamePlace = 0.2;                      ///< distance of corners [sizes]
constexpr double kSameWindow = 0.6;                     ///< intersection over union

}  // namespace

Sameness::Sameness(const Quadrilateral& quad)
    : quad_(quad),
      same_px_(kSameQuadPx + kSameQuad * geometry::rootArea(quad)),
      place_px_(kSamePlace * geometry::rootArea(quad)) {}

bool Sameness::sameWindow(const Quadrilateral& other) const {
  return geometry::intersectionOverUnion(quad_, other) > kSameWindow;
}

}  // namespace window_ingress::detection
