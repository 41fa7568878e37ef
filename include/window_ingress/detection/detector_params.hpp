#pragma once

namespace window_ingress::detection {

struct PreprocessParams {
  int search_side_px =
      480;  ///< the search runs on the first pyramid level whose longer side is no longer [px]
  double blur_sigma_px = 0.4;  ///< Gaussian against noise, on the search level; 0: none [px]
  bool equalise = false;       ///< contrast-limited histogram equalisation of the search level

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("search_side_px", self.search_side_px, 64, 4096);
    field("blur_sigma_px", self.blur_sigma_px, 0.0, 10.0);
    field("equalise", self.equalise);
  }
};

struct EdgeMapParams {
  double high_quantile = 0.85;  ///< this part of all pixels has a smaller gradient than the upper threshold
  double low_ratio = 0.5;       ///< lower threshold over upper one
  double floor = 6.0;           ///< the upper threshold is never below this [grey levels a pixel]
  double ceiling = 30.0;        ///< the upper threshold is never above this [grey levels a pixel]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("high_quantile", self.high_quantile, 0.0, 1.0);
    field("low_ratio", self.low_ratio, 0.0, 1.0);
    field("floor", self.floor, 0.1, 255.0);
    field("ceiling", self.ceiling, 0.1, 255.0);
  }
};

struct HoughSegmentsParams {
  double min_length = 0.03;   ///< of a segment, in longer sides of the level
  double min_density = 0.55;  ///< edge pixels on a segment over its length

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_length", self.min_length, 0.005, 0.5);
    field("min_density", self.min_density, 0.0, 1.0);
  }
};

struct ClosingParams {
  double radius = 0.003;  ///< of the dilation, in longer sides of the level; at least one pixel

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("radius", self.radius, 0.0, 0.1);
  }
};

struct ContourPolygonsParams {
  double epsilon = 0.025;  ///< tolerance of the polygon, in perimeters of its outline

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("epsilon", self.epsilon, 0.001, 0.2);
  }
};

struct SegmentQuadsParams {
  double extension = 0.4;     ///< a segment may end this far before or behind a corner, in its own lengths
  double min_coverage = 0.4;  ///< part of each side that its segment covers

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("extension", self.extension, 0.0, 2.0);
    field("min_coverage", self.min_coverage, 0.0, 1.0);
  }
};

struct CandidateGatesParams {
  double min_area = 0.003;         ///< of the quadrilateral, in areas of the image (the farthest window)
  double max_area = 0.90;          ///< of the quadrilateral, in areas of the image (the nearest window)
  double min_aspect = 0.2;         ///< width over height, as seen
  double max_aspect = 3.5;         ///< width over height, as seen
  double max_angle_rad = 0.85;     ///< of a corner away from 90 degrees (the largest yaw) [rad]
  double min_side_support = 0.45;  ///< of the weakest side: part that runs along straight edges
  double min_contrast = 2.0;       ///< gradient of the weakest side [grey levels a pixel]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_area", self.min_area, 0.0, 1.0);
    field("max_area", self.max_area, 0.0, 1.0);
    field("min_aspect", self.min_aspect, 0.01, 1.0);
    field("max_aspect", self.max_aspect, 1.0, 100.0);
    field("max_angle_rad", self.max_angle_rad, 0.0, 1.5);
    field("min_side_support", self.min_side_support, 0.0, 1.0);
    field("min_contrast", self.min_contrast, 0.0, 255.0);
  }
};

struct AppearanceParams {
  double max_distance =
      0.5;  ///< Bhattacharyya distance beyond which a candidate is not the target, at most; 0 to 1
  double min_distance =
      0.25;  ///< that limit is never below this, however alike the rest of the reference image looks; 0 to 1

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_distance", self.max_distance, 0.0, 1.0);
    field("min_distance", self.min_distance, 0.0, 1.0);
  }
};

struct TrackParams {
  double max_gap_sec = 0.5;      ///< images further apart start anew [s]
  double reacquire_sec = 0.6;    ///< a lost window found again in its place within this time is the same [s]
  double reacquire_gate = 0.35;  ///< furthest from its place to be the same [window sides]
  int appearance_every = 15;     ///< frames between comparisons with the reference
  int confirmations =
      3;  ///< searches that must agree with a new track, or name another place, to be believed
  double survey_sec = 1.0;  ///< between looks for all windows in view, while one is followed; 0: none [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_gap_sec", self.max_gap_sec, 0.01, 60.0);
    field("reacquire_sec", self.reacquire_sec, 0.0, 60.0);
    field("reacquire_gate", self.reacquire_gate, 0.01, 0.5);
    field("appearance_every", self.appearance_every, 1, 100000);
    field("confirmations", self.confirmations, 1, 100);
    field("survey_sec", self.survey_sec, 0.0, 60.0);
  }
};

/// Parameters of all stages in the order of the pipeline.
struct DetectorParams {
  PreprocessParams preprocess;
  EdgeMapParams edges;
  HoughSegmentsParams lines;
  ClosingParams closing;
  ContourPolygonsParams contours;
  SegmentQuadsParams segment_quads;
  CandidateGatesParams gates;
  AppearanceParams appearance;
  TrackParams track;
  int max_candidates = 40;  ///< best candidates that are compared with each other and with the reference
  double min_score = 0.4;   ///< below this there is no detection
  double min_score_reference = 0.5;  ///< least score of what was compared with a reference
  double min_correlation =
      0.58;  ///< least correlation of what lies round the target with what the reference shows there

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.group("preprocess", self.preprocess);
    field.group("edges", self.edges);
    field.group("lines", self.lines);
    field.group("closing", self.closing);
    field.group("contours", self.contours);
    field.group("segment_quads", self.segment_quads);
    field.group("gates", self.gates);
    field.group("appearance", self.appearance);
    field.group("track", self.track);
    field("max_candidates", self.max_candidates, 1, 1000);
    field("min_score", self.min_score, 0.0, 1.0);
    field("min_score_reference", self.min_score_reference, 0.0, 1.0);
    field("min_correlation", self.min_correlation, 0.0, 1.0);
  }
};

}  // namespace window_ingress::detection
