#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "detection/alignment/ring_score.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Support of one side of a candidate by edges or a blob's outline.
struct SideSupport {
  double fraction = 0.0;   ///< part of the side that lies on edge pixels of its direction
  double contrast = 0.0;   ///< mean gradient under it [grey levels per pixel]
  double overshoot = 0.0;  ///< part of the stretches beyond its ends where the edge continues, as in a grid
};

/// Support of all four sides.
struct Support {
  explicit Support(const std::array<SideSupport, 4>& sides) {
    for (const SideSupport& side : sides) {
      least = std::min(least, side.fraction);
      mean += 0.25 * side.fraction;
      contrast = std::min(contrast, side.contrast);
      overshoot += 0.25 * side.overshoot;
    }
  }
  double least = 1.0, mean = 0.0, contrast = 255.0, overshoot = 0.0;
};

/// A quadrilateral that may be the window, in pixels of the search level, canonical order.
struct Candidate {
  /// In the undistorted level, where its sides are straight.
  geometry::Quadrilateral quad = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                  Eigen::Vector2d::Zero()};
  geometry::Quadrilateral seen = quad;  ///< in the raw level
  CandidateSource source = CandidateSource::kContour;
  double solidity = 1.0;  ///< area of the outline over area of its hull
  double closure = 1.0;   ///< 1: sides end in its corners; towards 0 if they stop short or run beyond
  std::array<SideSupport, 4> sides;
};

/// A candidate that passed the gates on single candidates, with its scores.
struct ScoredCandidate {
  Candidate found;               ///< as the search found it
  geometry::Quadrilateral quad;  ///< raw pixels
  double score = 0.0;            ///< confidence, whatever its size
  double size = 1.0;             ///< preference for its size
  double proposal = 0.0;         ///< rank in the search; 0 if its borders were located afterwards
  /// kOuterBorder, kPane, kDuplicate: another candidate replaces this one.
  RejectReason verdict = RejectReason::kNone;
  std::optional<AppearanceMatch> appearance;  ///< comparison with the reference, where possible
  bool located = false;                       ///< its borders were moved to the reference's
  std::optional<double> correlation;          ///< with the reference's surroundings, if aligned
  RingMatch match;                            ///< fine comparison of the aligned place
  double geometry = 0.0;                      ///< if located: score by geometry alone
  double border_score = 0.0;  ///< if located: how well colours about its borders match the reference, 0 to 1

  double rank() const { return score * size; }
};

/// Higher rank first; deterministic.
void sortByRank(std::vector<ScoredCandidate>& candidates);

/// Why a candidate was stopped, and by how much.
struct Rejection {
  RejectReason reason = RejectReason::kNone;
  double value = 0.0;
  double limit = 0.0;
};

/// One line of the trace for a candidate.
CandidateTrace traceOf(const ScoredCandidate& candidate, const Rejection& rejection);

}  // namespace window_ingress::detection
