#pragma once

#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/candidate_gates.hpp"
#include "window_ingress/detection/closing.hpp"
#include "window_ingress/detection/contour_polygons.hpp"
#include "window_ingress/detection/edge_map.hpp"
#include "window_ingress/detection/line_support.hpp"
#include "window_ingress/detection/nested_loops.hpp"
#include "window_ingress/detection/preprocess.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/reference_borders.hpp"
#include "window_ingress/detection/reference_shape.hpp"
#include "window_ingress/detection/segment_quads.hpp"
#include "window_ingress/detection/side_support.hpp"
#include "window_ingress/detection/track_params.hpp"
#include "window_ingress/detection/window_score.hpp"

namespace window_ingress::detection {

/// Parameters of all stages in the order of the pipeline.
struct DetectorParams {
  PreprocessParams preprocess;
  EdgeMapParams edges;
  EdgeRunsParams runs;
  LineSupportParams lines;
  ClosingParams closing;
  ContourPolygonsParams contours;
  SegmentQuadsParams segment_quads;
  SideSupportParams side_support;
  CandidateGatesParams gates;
  WindowScoreParams score;
  NestedLoopsParams nested;
  ReferenceBordersParams borders;
  ReferenceShapeParams shape;
  AppearanceParams appearance;
  BorderRefinementParams refinement;
  TrackParams track;
  int max_candidates = 40;  ///< best candidates that are compared with each other and with the reference
  double min_score = 0.4;   ///< below this there is no detection
  double min_score_reference = 0.5;  ///< the same for what was compared with a reference
  double min_correlation = 0.58;     ///< of what lies round the target with what the reference shows there

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.group("preprocess", self.preprocess);
    field.group("edges", self.edges);
    field.group("runs", self.runs);
    field.group("lines", self.lines);
    field.group("closing", self.closing);
    field.group("contours", self.contours);
    field.group("segment_quads", self.segment_quads);
    field.group("side_support", self.side_support);
    field.group("gates", self.gates);
    field.group("score", self.score);
    field.group("nested", self.nested);
    field.group("borders", self.borders);
    field.group("shape", self.shape);
    field.group("appearance", self.appearance);
    field.group("refinement", self.refinement);
    field.group("track", self.track);
    field("max_candidates", self.max_candidates, 1, 1000);
    field("min_score", self.min_score, 0.0, 1.0);
    field("min_score_reference", self.min_score_reference, 0.0, 1.0);
    field("min_correlation", self.min_correlation, 0.0, 1.0);
  }
};

}  // namespace window_ingress::detection
