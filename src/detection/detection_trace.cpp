#include "window_ingress/detection/detection_trace.hpp"

#include <cstdio>
#include <cstring>
#include <tuple>

namespace window_ingress::detection {
namespace {

struct Wording {
  const char* name;      ///< in tables
  const char* quantity;  ///< measured by the gate
  const char* relation;  ///< of the value to the limit when the gate rejects; empty: it has no measure
};

Wording wording(RejectReason reason) {
  switch (reason) {
    case RejectReason::kNone:
      return {"none", "score", ">="};
    case RejectReason::kBadImage:
      return {"bad_image", "side", "<"};
    case RejectReason::kNoCandidate:
      return {"no_candidate", "candidates", "<"};
    case RejectReason::kCorners:
      return {"corners", "corners", "!="};
    case RejectReason::kAreaSmall:
      return {"area_small", "area", "<"};
    case RejectReason::kAreaLarge:
      return {"area_large", "area", ">"};
    case RejectReason::kAspect:
      return {"aspect", "aspect", "outside"};
    case RejectReason::kSolidity:
      return {"solidity", "solidity", "<"};
    case RejectReason::kAngle:
      return {"angle", "angle off 90 deg [rad]", ">"};
    case RejectReason::kBorder:
      return {"border", "distance from border [px]", "<"};
    case RejectReason::kLineSupport:
      return {"line_support", "line support", "<"};
    case RejectReason::kContrast:
      return {"contrast", "contrast", "<"};
    case RejectReason::kRefinement:
      return {"refinement", "profiles on the line", "<"};
    case RejectReason::kOuterBorder:
      return {"outer_border", "outer border of a frame whose inner one is seen", ""};
    case RejectReason::kDuplicate:
      return {"duplicate", "same loop, rank", "<"};
    case RejectReason::kPane:
      return {"pane", "within a larger loop that counts", ""};
    case RejectReason::kAppearance:
      return {"appearance", "Bhattacharyya distance", ">"};
    case RejectReason::kOtherAspect:
      return {"other_aspect", "misfit of the reference's aspect [sigma]", ">"};
    case RejectReason::kOtherFrame:
      return {"other_frame", "width of the frame over the reference's", "outside"};
    case RejectReason::kUnlike:
      return {"unlike", "correlation with the reference's surroundings", "<"};
    case RejectReason::kScore:
      return {"score", "score", "<"};
    case RejectReason::kOutscored:
      return {"outscored", "outscored,", "<"};
    case RejectReason::kBudget:
      return {"budget", "rank", ">"};
  }
  return {"unknown", "value", "?"};
}

}  // namespace

const char* toString(RejectReason reason) { return wording(reason).name; }

const char* toString(CandidateSource source) {
  switch (source) {
    case CandidateSource::kContour:
      return "contour";
    case CandidateSource::kBlob:
      return "blob";
    case CandidateSource::kSegments:
      return "segments";
    case CandidateSource::kReference:
      return "reference";
  }
  return "unknown";
}

void DetectionTrace::clear() {
  std::vector<CandidateTrace> memory;
  memory.swap(candidates);
  memory.clear();
  *this = DetectionTrace();
  candidates.swap(memory);
}

std::string describe(const CandidateTrace& candidate) {
  const Wording words = wording(candidate.reject);
  const char* relation = words.relation;
  if (std::strcmp(relation, "outside") == 0) relation = candidate.value > candidate.limit ? ">" : "<";
  char text[96];
  if (candidate.reject == RejectReason::kNone)
    std::snprintf(text, sizeof text, "target, score %.2f", candidate.score);
  else if (words.relation[0] == '\0')
    std::snprintf(text, sizeof text, "%s", words.quantity);
  else
    std::snprintf(text, sizeof text, "%s %.3g %s %.3g", words.quantity, candidate.value, relation,
                  candidate.limit);
  return text;
}

// Without a target: the reason of the candidate that came furthest.
void explain(DetectionTrace& trace) {
  if (trace.target >= 0) {
    trace.outcome = RejectReason::kNone;
    return;
  }
  // That one is like another candidate, or worse, explains nothing.
  const auto rank = [](const CandidateTrace& c) {
    const bool tells = c.reject != RejectReason::kDuplicate && c.reject != RejectReason::kOutscored;
    return std::make_tuple(tells, c.score, c.reject);
  };
  const CandidateTrace* furthest = nullptr;
  for (const CandidateTrace& c : trace.candidates)
    if (!furthest || rank(c) > rank(*furthest)) furthest = &c;
  if (furthest) {
    trace.outcome = furthest->reject;
    trace.detail = describe(*furthest);
  } else {
    trace.detail =
        std::to_string(trace.contours) + " contours, " + std::to_string(trace.segments) + " segments";
  }
  if (trace.budget_exceeded) trace.detail += "; budget exceeded: not everything was looked at";
}

void traceFollowed(const WindowObservation& window, DetectionTrace& trace) {
  trace.outcome = RejectReason::kNone;
  trace.detail.clear();
  trace.candidates.clear();
  trace.target = -1;
  trace.contours = trace.segments = 0;
  trace.budget_exceeded = false;
  if (!window.whole()) return;
  CandidateTrace candidate;
  candidate.quad = window.corners;
  candidate.score = window.score;
  candidate.has_appearance = window.has_appearance;
  candidate.bhattacharyya = window.bhattacharyya;
  trace.candidates.push_back(candidate);
  trace.target = 0;
}

void traceRefused(const DetectionTrace& search, RejectReason reason, const std::string& detail,
                  DetectionTrace& trace) {
  trace = search;
  trace.target = -1;
  trace.outcome = reason;
  trace.detail = detail;
}

}  // namespace window_ingress::detection
