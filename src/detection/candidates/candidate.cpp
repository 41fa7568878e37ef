#include "detection/candidates/candidate.hpp"

#include <algorithm>
#include <tuple>

namespace window_ingress::detection {

CandidateTrace traceOf(const ScoredCandidate& candidate, RejectReason reason, double value, double limit) {
  return {candidate.quad,
          candidate.found.source,
          reason,
          value,
          limit,
          candidate.score,
          candidate.appearance.has_value(),
          candidate.appearance ? candidate.appearance->distance : 0.0,
          candidate.correlation.value_or(0.0),
          candidate.proposal};
}

void sortByRank(std::vector<ScoredCandidate>& candidates) {
  // Equal ranks are ordered by place, so that the result does not depend on the previous order.
  const auto key = [](const ScoredCandidate& r) {
    return std::make_tuple(-r.rank(), r.quad[0].x(), r.quad[0].y(), r.quad[2].x(), r.quad[2].y());
  };
  std::sort(candidates.begin(), candidates.end(),
            [&key](const ScoredCandidate& a, const ScoredCandidate& b) { return key(a) < key(b); });
}

}  // namespace window_ingress::detection
