#include "window_ingress/detection/detection_trace.hpp"

#include <cstdio>
#include <cstring>
#include <iterator>
#include <tuple>
#include <utility>

namespace window_ingress::detection {
namespace {

struct Wording {
  const char* name;      ///< in tables
  const char* quantity;  ///< measured by the gate
  const char* relation;  ///< of value to limit when the gate rejects; empty: no measured quantity
};

/// In the order of `RejectReason`.
constexpr Wording kWordings[] = {
    {"none", "score", ">="},
    {"bad_image", "side", "<"},
    {"no_candidate", "candidates", "<"},
    {"corners", "corners", "!="},
    {"area_small", "area", "<"},
    {"area_large", "area", ">"},
    {"aspect", "aspect", "outside"},
    {"solidity", "solidity", "<"},
    {"angle", "angle off 90 deg [rad]", ">"},
    {"border", "distance from border [px]", "<"},
    {"line_support", "line support", "<"},
    {"contrast", "contrast", "<"},
    {"refinement", "profiles on the line", "<"},
    {"outer_border", "outer border of a frame whose inner one is seen", ""},
    {"duplicate", "same loop, rank", "<"},
    {"pane", "within a larger loop that counts", ""},
    {"appearance", "Bhattacharyya distance", ">"},
    {"other_aspect", "misfit of the reference's aspect [sigma]", ">"},
    {"other_frame", "width of the frame over the reference's", "outside"},
    {"unlike", "correlation with the reference's surroundings", "<"},
    {"score", "score", "<"},
    {"outscored", "score weighed by size", "<"},
    {"budget", "rank", ">"},
};
static_assert(std::size(kWordings) == kRejectReasons);

const Wording& wording(RejectReason reason) { return kWordings[static_cast<int>(reason)]; }

}  // namespace

const char* toString(RejectReason reason) { return wording(reason).name; }

const char* toString(CandidateSource source) {
  static constexpr const char* kNames[] = {"contour", "blob", "segments", "reference"};
  return kNames[static_cast<int>(source)];
}

void DetectionTrace::clear() {
  auto memory = std::move(candidates);
  memory.clear();
  *this = DetectionTrace();
  candidates = std::move(memory);
}

std::string describe(const CandidateTrace& candidate) {
  const Wording& words = wording(candidate.reject);
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

// Without a target: gives the reason of the candidate that passed the most gates.
void explain(DetectionTrace& trace) {
  if (trace.target >= 0) {
    trace.outcome = RejectReason::kNone;
    return;
  }
  // Being a duplicate, or worse than another candidate, explains nothing.
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
  trace.clear();
  trace.outcome = RejectReason::kNone;
  if (!window.whole()) return;
  CandidateTrace candidate;
  candidate.quad = window.corners;
  candidate.score = window.score;
  candidate.has_appearance = window.has_appearance;
  candidate.bhattacharyya = window.bhattacharyya;
  trace.candidates.push_back(candidate);
  trace.target = 0;
}

}  // namespace window_ingress::detection
