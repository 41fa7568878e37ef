#pragma once

#include <string>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// The gate that rejected a candidate or the whole image.
enum class RejectReason {
  kNone,         ///< not rejected: the target
  kBadImage,     ///< whole image: empty, of another type, or too small to hold a window
  kNoCandidate,  ///< whole image: nothing in it has four sides
  kCorners,      ///< its outline does not have four corners
  kAreaSmall,    ///< smaller than the farthest window
  kAreaLarge,    ///< larger than the nearest window
  kAspect,       ///< too wide or too narrow
  kSolidity,     ///< outline much smaller than its convex hull
  kAngle,        ///< a corner too far from a right angle
  kBorder,       ///< cut off by the image border: a corner is not seen
  kLineSupport,  ///< a side is not supported by straight edges
  kContrast,     ///< an edge too weak to be distinguished from noise
  kRefinement,   ///< an edge could not be fitted in the full image
  kOuterBorder,  ///< the outer border of a frame whose inner border was found
  kDuplicate,    ///< the same loop as a better candidate
  kPane,         ///< part of a larger window: a pane between mullions, or a border behind the opening
  kAppearance,   ///< its frame does not look like the reference
  kOtherAspect,  ///< its aspect differs from the reference's
  kOtherFrame,   ///< its frame is wider or narrower than the reference's
  kUnlike,       ///< its surroundings do not match those of the reference's opening
  kScore,        ///< its score is below the limit
  kOutscored,    ///< a valid window, but another one is better
  kBudget        ///< not examined: too many candidates in one image
};
constexpr int kRejectReasons = static_cast<int>(RejectReason::kBudget) + 1;

const char* toString(RejectReason reason);

/// Where a candidate came from.
enum class CandidateSource {
  kContour,   ///< a closed contour of edges
  kBlob,      ///< the outline of a region whose colour differs from its surroundings
  kSegments,  ///< four straight segments that meet
  kReference  ///< borders located next to a candidate by the colours of the reference
};

const char* toString(CandidateSource source);

/// Result for one candidate. `value` and `limit` are those of the gate that rejected it.
struct CandidateTrace {
  geometry::Quadrilateral quad;  ///< distorted pixels
  CandidateSource source = CandidateSource::kContour;
  RejectReason reject = RejectReason::kNone;
  double value = 0.0;
  double limit = 0.0;
  double score = 0.0;
  bool has_appearance = false;
  double bhattacharyya = 0.0;
  double correlation = 0.0;  ///< of its surroundings with the reference's; 0: not compared
  double proposal = 0.0;     ///< rank in the search before it is judged; 0: stopped at the gates
};

/// For people: "aspect 3.1 > 2.5".
std::string describe(const CandidateTrace& candidate);

/// What happened in one image.
struct DetectionTrace {
  RejectReason outcome = RejectReason::kNoCandidate;  ///< kNone if there is a target
  std::string detail;                                 ///< the outcome in words, with numbers; empty for kNone
  std::vector<CandidateTrace> candidates;
  int target = -1;               ///< index into `candidates`, or -1
  int contours = 0;              ///< closed contours seen
  int segments = 0;              ///< straight segments seen
  bool budget_exceeded = false;  ///< a count limit was reached: something may have been missed

  void clear();  ///< resets it, but keeps the allocated memory
};

/// Sets outcome and detail; without a target, the reason of the candidate that got furthest.
void explain(DetectionTrace& trace);

/// Trace of a frame with a tracked window, which is the only candidate if it is whole.
void traceFollowed(const WindowObservation& window, DetectionTrace& trace);

}  // namespace window_ingress::detection
