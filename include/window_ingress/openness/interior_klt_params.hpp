#pragma once

namespace window_ingress::openness {

/// How texture within the opening is followed; see `InteriorKltTracker`.
struct InteriorKltParams {
  bool enabled = true;           ///< follow the texture within the opening; false costs nothing
  int max_points = 50;           ///< followed at once
  int min_points = 6;            ///< with fewer left a new key image is taken
  double most_px = 160.0;        ///< longer side of the straightened image of the opening, at most [px]
  int max_edges = 30;            ///< points on edges, followed across them
  double least_slope = 3.0;      ///< of an edge that is followed [grey levels a pixel]
  double margin = 0.07;          ///< beside the border that is not looked at, part of the opening's sides
  double min_contrast = 5e-5;    ///< of a point: lesser eigenvalue of the gradient's moments
  double max_return_px = 0.8;    ///< that a point may miss itself by when followed there and back [px]
  double most_slope = 0.7;       ///< of noise and shading within a surface [grey levels a pixel]
  double flow_sigma_px = 0.35;   ///< of a followed point, in the straightened image [px]
  double max_growth = 1.25;      ///< of the window in the image, until a new key image
  double max_key_age_sec = 4.0;  ///< of a key image [s]
  double min_shared = 0.4;       ///< part of the key image's points that must be left

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("enabled", self.enabled);
    field("max_points", self.max_points, 8, 400);
    field("min_points", self.min_points, 4, 200);
    field("most_px", self.most_px, 48.0, 640.0);
    field("max_edges", self.max_edges, 0, 400);
    field("least_slope", self.least_slope, 0.5, 100.0);
    field("margin", self.margin, 0.0, 0.3);
    field("min_contrast", self.min_contrast, 1e-6, 1.0);
    field("max_return_px", self.max_return_px, 0.05, 5.0);
    field("most_slope", self.most_slope, 0.0, 20.0);
    field("flow_sigma_px", self.flow_sigma_px, 0.05, 5.0);
    field("max_growth", self.max_growth, 1.05, 3.0);
    field("max_key_age_sec", self.max_key_age_sec, 0.2, 60.0);
    field("min_shared", self.min_shared, 0.1, 0.9);
  }
};

}  // namespace window_ingress::openness
