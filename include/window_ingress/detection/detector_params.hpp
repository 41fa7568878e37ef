#pragma once

namespace window_ingress::detection {

struct PreprocessParams {
  int search_side_px = 480;    ///< the image is halved for the search until it is no longer than this
                               ///< [px]
  double blur_sigma_px = 0.4;  ///< sigma of the Gaussian blur on the search level; 0: none [px]
  bool equalise = false;       ///< equalise the histogram of the search level with limited contrast

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("search_side_px", self.search_side_px, 64, 4096);
    field("blur_sigma_px", self.blur_sigma_px, 0.0, 10.0);
    field("equalise", self.equalise);
  }
};

struct CannyParams {
  double high_quantile = 0.85;  ///< part of all pixels whose gradient is below the upper threshold
  double low_ratio = 0.5;       ///< lower threshold over upper threshold
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
  double min_length = 0.03;   ///< least length of a segment, in longer sides of the search level
  double min_density = 0.55;  ///< least number of edge pixels on a segment, over its length

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_length", self.min_length, 0.005, 0.5);
    field("min_density", self.min_density, 0.0, 1.0);
  }
};

struct DilationParams {
  double radius = 0.003;  ///< radius of the dilation, in longer sides of the search level; at least one pixel

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("radius", self.radius, 0.0, 0.1);
  }
};

struct ContourPolygonsParams {
  double epsilon = 0.025;  ///< tolerance of the polygon approximation, in perimeters of the outline

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("epsilon", self.epsilon, 0.001, 0.2);
  }
};

struct SegmentQuadsParams {
  double extension = 0.4;     ///< largest gap between a segment's end and a corner, in segment lengths
  double min_coverage = 0.4;  ///< least part of each side that its segment covers

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("extension", self.extension, 0.0, 2.0);
    field("min_coverage", self.min_coverage, 0.0, 1.0);
  }
};

struct CandidateGatesParams {
  double min_area = 0.003;         ///< least area of a candidate, in areas of the image (farthest window)
  double max_area = 0.90;          ///< largest area of a candidate, in areas of the image (nearest window)
  double min_aspect = 0.2;         ///< least width over height of a candidate, as seen
  double max_aspect = 3.5;         ///< largest width over height of a candidate, as seen
  double max_angle_rad = 0.85;     ///< largest deviation of a corner from 90 degrees (the largest yaw) [rad]
  double min_side_support = 0.45;  ///< least part of the weakest side that runs along straight edges
  double min_contrast = 2.0;       ///< least gradient of the weakest side [grey levels a pixel]

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
  double max_distance = 0.5;   ///< the limit on the Bhattacharyya distance, from the reference, is never
                               ///< above this; 0 to 1
  double min_distance = 0.25;  ///< the limit on the Bhattacharyya distance, from the reference, is never
                               ///< below this; 0 to 1

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_distance", self.max_distance, 0.0, 1.0);
    field("min_distance", self.min_distance, 0.0, 1.0);
  }
};

struct TrackParams {
  double max_gap_sec = 0.5;      ///< tracking starts anew when images are further apart than this [s]
  double reacquire_sec = 0.6;    ///< longest loss after which a window keeps its number [s]
  double reacquire_gate = 0.35;  ///< largest move after which a lost window keeps its number [window sides]
  int appearance_every = 15;     ///< frames between two comparisons of a tracked window with the reference
  int confirmations = 3;  ///< searches that confirm a new track, or that end it by agreeing on another place
  double survey_sec = 1.0;  ///< time between searches for all windows while one is tracked; 0: none [s]

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
  CannyParams edges;
  HoughSegmentsParams lines;
  DilationParams closing;
  ContourPolygonsParams contours;
  SegmentQuadsParams segment_quads;
  CandidateGatesParams gates;
  AppearanceParams appearance;
  TrackParams track;
  int max_candidates = 40;  ///< number of best candidates compared with each other and with the reference
  double min_score = 0.4;   ///< least score of a detection without a reference
  double min_score_reference = 0.5;  ///< least score with a reference, unless found by correlation
  double min_correlation = 0.58;     ///< least correlation of the target's surroundings with the reference

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
