#pragma once

#include <array>
#include <optional>
#include <vector>

#include "detection/alignment/ring_score.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// What edges, or the outline of a blob, say about one side of a candidate.
struct SideSupport {
  double fraction = 0.0;   ///< part of the side that runs along edge pixels of its direction
  double contrast = 0.0;   ///< mean gradient under it [grey levels a pixel]
  double overshoot = 0.0;  ///< part of the stretches beyond its two ends where the edge goes on, as in a grid
};

/// A quadrilateral that may be the window, in pixels of the search level, canonical order.
struct Candidate {
  geometry::Quadrilateral quad = {
      Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
      Eigen::Vector2d::Zero()};  ///< of the undistorted level, where its sides are straight
  geometry::Quadrilateral seen = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                  Eigen::Vector2d::Zero()};  ///< of the level as it came
  CandidateSource source = CandidateSource::kContour;
  double solidity = 1.0;  ///< area of the outline over area of its hull
  double closure =
      1.0;  ///< 1: its sides end in its corners; towards 0 the further they stop short or run beyond
  std::array<SideSupport, 4> sides;
};

/// A candidate that passed the gates on single candidates, and what is found out about it.
struct ScoredCandidate {
  Candidate candidate;
  geometry::Quadrilateral quad;  ///< pixels of the image as it came
  double score = 0.0;            ///< confidence, whatever its size
  double size = 1.0;             ///< preference for its size
  double proposal = 0.0;         ///< its rank in the search; 0 where its borders were located afterwards
  RejectReason verdict = RejectReason::kNone;  ///< kOuterBorder, kPane, kDuplicate: another one is taken
  std::optional<AppearanceMatch> appearance;   ///< beside the reference, where it can be compared
  bool located = false;                        ///< its borders are where the reference's are
  std::optional<double> correlation;           ///< with the reference's surroundings, where they were aligned
  RingMatch match;                             ///< of that place, finely compared
  double geometry = 0.0;                       ///< then: its score by geometry alone
  double worth = 0.0;  ///< then: how far the colours about its borders are those of the reference, 0 to 1

  double rank() const { return score * size; }
};

/// Higher rank first; deterministic.
void sortByRank(std::vector<ScoredCandidate>& rivals);

/// One line of the trace for a rival.
CandidateTrace traceOf(const ScoredCandidate& rival, RejectReason reason, double value, double limit);

}  // namespace window_ingress::detection
