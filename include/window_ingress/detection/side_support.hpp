#pragma once

#include <array>

#include "window_ingress/detection/candidate.hpp"
#include "window_ingress/detection/edge_map.hpp"
#include "window_ingress/detection/level_lens.hpp"

namespace window_ingress::detection {

struct SideSupportParams {
  double tolerance_px = 2.0;    ///< distance of an edge pixel from the side, on the search level [px]
  double direction_rad = 0.35;  ///< angle between its gradient and the side's normal [rad]
  double skip = 0.06;           ///< left out at both ends: corners are rounded, in lengths of the side

  double beyond = 0.2;  ///< stretch beyond each corner that is looked at, in lengths of the side

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("tolerance_px", self.tolerance_px, 0.0, 10.0);
    field("direction_rad", self.direction_rad, 0.01, 1.5);
    field("beyond", self.beyond, 0.0, 2.0);
    field("skip", self.skip, 0.0, 0.4);
  }
};

/// How well the sides of a quadrilateral of the undistorted level run along straight edges.
std::array<SideSupport, 4> measureSides(const EdgeMap& map, const LevelLens& lens,
                                        const geometry::Quadrilateral& quad, const SideSupportParams& params);

}  // namespace window_ingress::detection
