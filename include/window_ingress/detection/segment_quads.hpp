#pragma once

#include <vector>

#include "window_ingress/detection/candidate.hpp"
#include "window_ingress/detection/line_support.hpp"

namespace window_ingress::detection {

struct SegmentQuadsParams {
  double extension = 0.4;       ///< a segment may end this far before or behind a corner, in its own lengths
  double min_coverage = 0.4;    ///< part of each side that its segment covers
  double mean_coverage = 0.65;  ///< mean of the four sides
  double min_angle_rad = 0.6;   ///< between neighbouring sides [rad]
  double closure_px =
      1.5;  ///< mean distance of segment ends from corners that takes e-fold off the closure [px]
  double closure_side = 0.02;  ///< added to that, in mean sides of the quadrilateral
  int max_segments = 250;      ///< the longest segments that are combined
  int max_quads = 300;         ///< the best covered are kept

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("extension", self.extension, 0.0, 2.0);
    field("min_coverage", self.min_coverage, 0.0, 1.0);
    field("mean_coverage", self.mean_coverage, 0.0, 1.0);
    field("min_angle_rad", self.min_angle_rad, 0.1, 1.5);
    field("closure_px", self.closure_px, 0.1, 100.0);
    field("closure_side", self.closure_side, 0.0, 1.0);
    field("max_segments", self.max_segments, 4, 5000);
    field("max_quads", self.max_quads, 1, 100000);
  }
};

/// Quadrilaterals whose four sides are straight segments and whose corners are the segments' intersections:
/// finds the windows whose contour is broken or runs into its neighbours (P4 selects and constrains, P7).
class SegmentQuads {
 public:
  struct Result {
    std::vector<Candidate> candidates;  ///< best covered first
    bool budget_exceeded = false;
  };

  explicit SegmentQuads(const SegmentQuadsParams& params) : params_(params) {}

  Result run(const std::vector<Segment>& segments, double min_area_px) const;

 private:
  SegmentQuadsParams params_;
};

}  // namespace window_ingress::detection
