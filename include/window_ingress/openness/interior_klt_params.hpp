#pragma once

namespace window_ingress::openness {

/// How the texture within the opening is tracked.
struct InteriorKltParams {
  bool enabled = true;         ///< track the texture within the opening; without it no opening is verified
  int max_points = 50;         ///< number of corners tracked within the opening; each costs time
  int max_edges = 30;          ///< number of edge points tracked across their edges; each costs time
  double max_side_px = 160.0;  ///< longer side of the opening's rectified image; larger costs time [px]
  double surface_slope = 0.7;  // of noise and shading within a surface [grey levels a pixel]; not in `visit`

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled);
    field("max_points", self.max_points, 8, 400);
    field("max_edges", self.max_edges, 0, 400);
    field("max_side_px", self.max_side_px, 48.0, 640.0);
  }
};

}  // namespace window_ingress::openness
