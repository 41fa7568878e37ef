#include "window_ingress/detection/track_trace.hpp"

namespace window_ingress::detection {

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
