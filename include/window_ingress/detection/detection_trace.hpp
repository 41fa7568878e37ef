#pragma once

#include <string>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// The gate that stopped a candidate, or the whole image.
enum class RejectReason {
  kNone,         ///< not rejected: the target
  kBadImage,     ///< whole image: empty, of another type, or too small to hold a window
  kNoCandidate,  ///< whole image: nothing with four sides in it
  kCorners,      ///< its outline has no four corners
  kAreaSmall,    ///< smaller than the farthest window
  kAreaLarge,    ///< larger than the nearest window
  kAspect,       ///< too wide or too narrow
  kSolidity,     ///< outline much smaller than its convex hull
  kAngle,        ///< a corner too far from a right angle
  kBorder,       ///< cut by the border of the image: a corner is not seen
  kLineSupport,  ///< a side without straight edges under it
  kContrast,     ///< an edge too weak to be told from noise
  kRefinement,   ///< an edge could not be fitted in the full image
  kOuterBorder,  ///< the outer border of a frame whose inner border was found
  kDuplicate,    ///< the same loop as a better candidate
  kPane,         ///< a part of a larger window: pane between mullions, border behind the opening
  kAppearance,   ///< its frame does not look like the reference
  kOtherAspect,  ///< of another aspect than the reference
  kOtherFrame,   ///< its frame is wider or narrower than the reference's
  kUnlike,       ///< what lies round it is not what lies round the reference's opening
  kScore,        ///< score below the limit
  kOutscored,    ///< a fair window, but another one is better
  kBudget        ///< not looked at: too many candidates in one image
};
constexpr int kRejectReasons = static_cast<int>(RejectReason::kBudget) + 1;

const char* toString(RejectReason reason);

/// Where a candidate came from.
enum class CandidateSource {
  kContour,   ///< a closed contour of edges
  kBlob,      ///< the outline of a region of another colour than what surrounds it
  kSegments,  ///< four straight segments that meet
  kReference  ///< borders located beside a candidate, by the colours of the reference
};

const char* toString(CandidateSource source);

/// What became of one candidate. `value` and `limit` are those of the gate that rejected it.
struct CandidateTrace {
  geometry::Quadrilateral quad;  ///< pixels of the image as it came
  CandidateSource source = CandidateSource::kContour;
  RejectReason reject = RejectReason::kNone;
  double value = 0.0;
  double limit = 0.0;
  double score = 0.0;
  bool has_appearance = false;
  double bhattacharyya = 0.0;
  double correlation = 0.0;  ///< of what lies round it with what the reference shows there; 0: not compared
  double proposal = 0.0;  ///< how much the search thinks of it before it is judged; 0: stopped at the gates
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
  bool budget_exceeded = false;  ///< a limit on counts was reached: something may have been overlooked

  void clear();  ///< as new, but keeps its memory
};

/// Sets outcome and detail: without a target the reason of the candidate that came furthest.
void explain(DetectionTrace& trace);

/// The trace of a frame in which a window was followed: it is the only candidate, if it is whole.
void traceFollowed(const WindowObservation& window, DetectionTrace& trace);

}  // namespace window_ingress::detection
