#pragma once

namespace window_ingress::detection {

struct PreprocessParams {
  int search_side_px =
      480;  ///< the search runs on the first pyramid level whose longer side is no longer [px]
  double blur_sigma_px = 0.4;  ///< Gaussian against noise, on the search level; 0: none [px]
  bool equalise = false;       ///< contrast-limited histogram equalisation of the search level
  double colour_gain = 2.0;    ///< of differences between channels, in the picture of colours alone

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("search_side_px", self.search_side_px, 64, 4096);
    field("blur_sigma_px", self.blur_sigma_px, 0.0, 10.0);
    field("equalise", self.equalise);
    field("colour_gain", self.colour_gain, 0.1, 10.0);
  }
};

struct EdgeMapParams {
  double high_quantile = 0.85;  ///< this part of all pixels has a smaller gradient than the upper threshold
  double low_ratio = 0.5;       ///< lower threshold over upper one
  double floor = 6.0;           ///< the upper threshold is never below this [grey levels a pixel]
  double ceiling = 30.0;        ///< nor above this [grey levels a pixel]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("high_quantile", self.high_quantile, 0.0, 1.0);
    field("low_ratio", self.low_ratio, 0.0, 1.0);
    field("floor", self.floor, 0.1, 255.0);
    field("ceiling", self.ceiling, 0.1, 255.0);
  }
};

struct EdgeRunsParams {
  double turn_rad = 0.7;     ///< a pixel follows another if their gradients differ less than this [rad]
  double straight_px = 0.9;  ///< a run leaves its chord by less than this, at a level side of 320 [px]
  double bow = 0.02;         ///< and by this part of the chord: lenses bend
  int min_pixels = 4;        ///< of a run; shorter ones are dropped

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("turn_rad", self.turn_rad, 0.05, 1.5);
    field("straight_px", self.straight_px, 0.3, 10.0);
    field("bow", self.bow, 0.0, 0.1);
    field("min_pixels", self.min_pixels, 2, 1000);
  }
};

struct LineSupportParams {
  double min_length = 0.03;    ///< of a segment, in longer sides of the level
  double max_gap = 0.02;       ///< within a segment, in longer sides of the level
  double vote_fraction = 0.7;  ///< votes that start a segment, in pixels of the minimum length
  double off_line =
      0.004;          ///< ends of the runs of one line lie this close to it, in longer sides of the level
  double bow = 0.02;  ///< and further by this part of the line's pixels: lenses bend
  double min_density = 0.55;  ///< edge pixels on a segment over its length
  double join_gap =
      0.35;  ///< two pieces of one line are joined over a gap this long, in lengths of the pieces
  int max_segments = 300;  ///< the strongest are kept

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_length", self.min_length, 0.005, 0.5);
    field("max_gap", self.max_gap, 0.0, 0.5);
    field("vote_fraction", self.vote_fraction, 0.1, 1.0);
    field("off_line", self.off_line, 0.001, 0.05);
    field("bow", self.bow, 0.0, 0.1);
    field("min_density", self.min_density, 0.0, 1.0);
    field("join_gap", self.join_gap, 0.0, 5.0);
    field("max_segments", self.max_segments, 4, 100000);
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
  double epsilon = 0.025;       ///< tolerance of the polygon, in perimeters of its outline
  double hull_excess = 0.12;    ///< the four lines round a hull may add this part of its area
  double min_perimeter = 0.08;  ///< shorter outlines are not looked at, in longer sides of the level
  double closure = 0.7;         ///< given to them: closed, but their corners are no better than the outline
  int max_contours = 3000;      ///< budget for one image; the rest is not looked at

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("epsilon", self.epsilon, 0.001, 0.2);
    field("hull_excess", self.hull_excess, 0.0, 1.0);
    field("min_perimeter", self.min_perimeter, 0.0, 4.0);
    field("closure", self.closure, 0.01, 1.0);
    field("max_contours", self.max_contours, 1, 1000000);
  }
};

struct SegmentQuadsParams {
  double extension = 0.4;       ///< a segment may end this far before or behind a corner, in its own lengths
  double min_coverage = 0.4;    ///< part of each side that its segment covers
  double mean_coverage = 0.65;  ///< mean of the four sides
  double min_angle_rad = 0.6;   ///< between neighbouring sides [rad]
  double closure_px =
      1.5;  ///< mean distance of segment ends from corners that takes e-fold off the closure [px]
  double closure_side = 0.02;  ///< added to that, in mean sides of the quadrilateral
  double odd_side = 0.95;      ///< factor for each side that is brighter inside where most are darker, or so

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("extension", self.extension, 0.0, 2.0);
    field("min_coverage", self.min_coverage, 0.0, 1.0);
    field("mean_coverage", self.mean_coverage, 0.0, 1.0);
    field("min_angle_rad", self.min_angle_rad, 0.1, 1.5);
    field("closure_px", self.closure_px, 0.1, 100.0);
    field("closure_side", self.closure_side, 0.0, 1.0);
    field("odd_side", self.odd_side, 0.0, 1.0);
  }
};

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

struct CandidateGatesParams {
  double min_area = 0.003;      ///< of the quadrilateral, in areas of the image (the farthest window)
  double max_area = 0.90;       ///< of the quadrilateral, in areas of the image (the nearest window)
  double min_aspect = 0.2;      ///< width over height, as seen
  double max_aspect = 3.5;      ///< width over height, as seen
  double min_solidity = 0.8;    ///< area of the outline over area of its hull
  double max_angle_rad = 0.85;  ///< of a corner away from 90 degrees (the largest yaw) [rad]
  double border = 0.003;  ///< a corner this close to the image's border is cut, in longer sides of the image
  double min_side_support = 0.45;  ///< of the weakest side: part that runs along straight edges
  double mean_side_support = 0.7;  ///< of the four sides together
  double min_contrast = 2.0;       ///< gradient of the weakest side [grey levels a pixel]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("min_area", self.min_area, 0.0, 1.0);
    field("max_area", self.max_area, 0.0, 1.0);
    field("min_aspect", self.min_aspect, 0.01, 1.0);
    field("max_aspect", self.max_aspect, 1.0, 100.0);
    field("min_solidity", self.min_solidity, 0.0, 1.0);
    field("max_angle_rad", self.max_angle_rad, 0.0, 1.5);
    field("border", self.border, 0.0, 0.2);
    field("min_side_support", self.min_side_support, 0.0, 1.0);
    field("mean_side_support", self.mean_side_support, 0.0, 1.0);
    field("min_contrast", self.min_contrast, 0.0, 255.0);
  }
};

struct WindowScoreParams {
  double support_low = 0.4;       ///< support of a side that counts nothing
  double overshoot_weight = 1.0;  ///< exponent of the part that sides end at their corners
  double area_full = 0.06;    ///< area from which size makes no difference to the rank, in areas of the image
  double area_weight = 0.45;  ///< exponent of the area's part in the rank
  double closure_weight = 0.5;    ///< exponent of the closure's part
  double geometry_weight = 0.25;  ///< exponent of all of the above where there is a reference to compare with
  double worth_weight = 0.7;      ///< exponent of the worth of its borders, beside the reference's

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("support_low", self.support_low, 0.0, 0.99);
    field("overshoot_weight", self.overshoot_weight, 0.0, 4.0);
    field("area_full", self.area_full, 1e-4, 1.0);
    field("area_weight", self.area_weight, 0.0, 4.0);
    field("closure_weight", self.closure_weight, 0.0, 4.0);
    field("geometry_weight", self.geometry_weight, 0.0, 4.0);
    field("worth_weight", self.worth_weight, 0.0, 4.0);
  }
};

struct NestedLoopsParams {
  double max_ring = 0.25;        ///< width of a frame, in mean sides of its outer border
  double ring_ratio = 3.0;       ///< widest over narrowest side of a frame
  double uniform = 22.0;         ///< colours of a frame's four sides differ less than this [grey levels]
  double container_score = 1.0;  ///< a loop round panes wins if its score is at least this part of theirs
  double max_panes = 40.0;       ///< area of a window over the area of its smallest pane

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_ring", self.max_ring, 0.0, 0.5);
    field("ring_ratio", self.ring_ratio, 1.0, 100.0);
    field("uniform", self.uniform, 0.0, 442.0);
    field("container_score", self.container_score, 0.0, 10.0);
    field("max_panes", self.max_panes, 1.0, 1000.0);
  }
};

struct ReferenceBordersParams {
  double inward = 0.14;   ///< borders are looked for so far inside a rough loop, in mean sides of it
  double outward = 0.40;  ///< and so far outside
  double alike = 0.10;  ///< difference of colours from the reference's that takes e-fold off a border's worth
  double contrast_full = 10.0;  ///< change of the mean colour over two pixels that counts fully [grey levels]
  double step_full = 0.06;      ///< difference of the colours on both sides of a border that counts fully
  double brightness_weight = 0.25;  ///< of relative brightness beside chroma

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("inward", self.inward, 0.0, 0.4);
    field("outward", self.outward, 0.0, 0.6);
    field("alike", self.alike, 0.001, 10.0);
    field("contrast_full", self.contrast_full, 0.1, 255.0);
    field("step_full", self.step_full, 0.001, 10.0);
    field("brightness_weight", self.brightness_weight, 0.0, 10.0);
  }
};

struct ReferenceShapeParams {
  bool compare = true;         ///< else every shape will do
  double sigmas = 3.0;         ///< standard deviations that a shape may differ from the reference's
  double corner_px = 0.3;      ///< least standard deviation of a corner, each way [px]
  double aspect_sigma = 0.03;  ///< of the logarithm of the aspect: how well the reference shows it, at best
  double frame_px = 0.03;      ///< standard deviation of the width of a frame [px]
  double frame_slack = 0.15;   ///< that width may differ by this part beyond that

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("compare", self.compare);
    field("sigmas", self.sigmas, 0.0, 100.0);
    field("corner_px", self.corner_px, 0.0, 10.0);
    field("aspect_sigma", self.aspect_sigma, 0.001, 10.0);
    field("frame_px", self.frame_px, 0.0, 10.0);
    field("frame_slack", self.frame_slack, 0.0, 10.0);
  }
};

struct AppearanceParams {
  double near_width =
      0.05;  ///< first band of the ring round the border: the frame, in mean sides of the opening
  double far_width = 0.14;  ///< second band, its outer edge: frame and surround, in mean sides of the opening
  int min_pixels = 40;      ///< fewer pixels in a band are not compared
  double max_distance =
      0.5;  ///< Bhattacharyya distance beyond which a candidate is not the target, at most; 0 to 1
  double min_distance =
      0.25;                ///< and at least, however alike the rest of the reference picture looks; 0 to 1
  double max_drift = 0.3;  ///< slow adaptation: furthest Bhattacharyya distance from the operator's reference

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("near_width", self.near_width, 0.005, 0.5);
    field("far_width", self.far_width, 0.01, 1.0);
    field("min_pixels", self.min_pixels, 1, 100000);
    field("max_distance", self.max_distance, 0.0, 1.0);
    field("min_distance", self.min_distance, 0.0, 1.0);
    field("max_drift", self.max_drift, 0.0, 1.0);
  }
};

struct BorderRefinementParams {
  int samples = 80;              ///< profiles across each side, at most one a pixel
  double skip = 0.06;            ///< left out at both ends of a side, in its lengths
  double final_radius_px = 2.0;  ///< reach of the second pass, at a longer side of 640; grows with it [px]
  double outlier_px = 0.6;       ///< scale of the robust fit, at a longer side of 640; grows with it [px]
  double min_inliers = 0.4;      ///< part of a side's profiles that must lie on its line
  double sigma_floor_px = 0.03;  ///< no edge is claimed to be known better than this [px]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("samples", self.samples, 4, 2000);
    field("skip", self.skip, 0.0, 0.4);
    field("final_radius_px", self.final_radius_px, 1.0, 20.0);
    field("outlier_px", self.outlier_px, 0.05, 10.0);
    field("min_inliers", self.min_inliers, 0.0, 1.0);
    field("sigma_floor_px", self.sigma_floor_px, 1e-4, 10.0);
  }
};

struct TrackParams {
  double reach = 0.0094;        ///< furthest a border may lie from where it is predicted [longer image sides]
  int profiles = 18;            ///< across each side to find the border again
  int fine_profiles = 40;       ///< across each side to fit its line
  double min_similarity = 0.5;  ///< correlation of a side's profile with the remembered one, 0 to 1
  double min_inliers = 0.4;     ///< part of a side's profiles that must lie on its line
  double min_stretch =
      0.06;  ///< shortest part of a side in the picture that is a border [longer image sides]
  double min_certainty = 0.4;  ///< below this the track is given up and the window searched, 0 to 1
  double max_shape_change =
      0.06;            ///< of aspect, skew and keystone between frames beyond the prediction [sides]
  double turn = 0.12;  ///< unforeseen motion of the window's place without attitude [longer image sides/s]
  double turn_known = 0.06;      ///< the same with attitude at both exposures [longer image sides/s]
  double reshape = 0.25;         ///< unforeseen change of its size and roll [window sides/s]
  double warp = 0.08;            ///< unforeseen change of aspect, skew and keystone [window sides/s]
  double max_gap_sec = 0.5;      ///< pictures further apart start anew [s]
  double reacquire_sec = 0.6;    ///< a lost window found again in its place within this time is the same [s]
  double reacquire_gate = 0.35;  ///< furthest from its place to be the same [window sides]
  int settled = 5;            ///< frames after which a lost window is waited for before another one is taken
  int appearance_every = 15;  ///< frames between comparisons with the reference
  double adaptation = 0.1;    ///< part of a difference in appearance that such a comparison takes over
  double likeness_margin =
      0.2;  ///< a window less like the reference than the target was by this is another one
  double likeness_sec = 10.0;    ///< so long after the target was last compared [s]
  double adapt_certainty = 0.8;  ///< only above this the reference follows the light, 0 to 1
  int confirmations =
      3;  ///< searches that must agree with a new track, or name another place, to be believed
  int question_every = 2;   ///< frames between such searches
  double survey_sec = 1.0;  ///< between looks for all windows in view, while one is followed; 0: none [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("reach", self.reach, 0.002, 0.1);
    field("profiles", self.profiles, 6, 200);
    field("fine_profiles", self.fine_profiles, 6, 400);
    field("min_similarity", self.min_similarity, 0.0, 1.0);
    field("min_inliers", self.min_inliers, 0.0, 1.0);
    field("min_stretch", self.min_stretch, 0.01, 0.5);
    field("min_certainty", self.min_certainty, 0.0, 1.0);
    field("max_shape_change", self.max_shape_change, 0.001, 1.0);
    field("turn", self.turn, 0.001, 10.0);
    field("turn_known", self.turn_known, 0.001, 10.0);
    field("reshape", self.reshape, 0.001, 10.0);
    field("warp", self.warp, 0.001, 10.0);
    field("max_gap_sec", self.max_gap_sec, 0.01, 60.0);
    field("reacquire_sec", self.reacquire_sec, 0.0, 60.0);
    field("reacquire_gate", self.reacquire_gate, 0.01, 0.5);
    field("settled", self.settled, 1, 1000);
    field("appearance_every", self.appearance_every, 1, 100000);
    field("adaptation", self.adaptation, 0.0, 1.0);
    field("likeness_margin", self.likeness_margin, 0.01, 1.0);
    field("likeness_sec", self.likeness_sec, 0.0, 1000.0);
    field("adapt_certainty", self.adapt_certainty, 0.0, 1.0);
    field("confirmations", self.confirmations, 1, 100);
    field("question_every", self.question_every, 1, 1000);
    field("survey_sec", self.survey_sec, 0.0, 60.0);
  }
};

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
