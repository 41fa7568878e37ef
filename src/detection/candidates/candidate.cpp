#include "detection/candidates/candidate.hpp"

#include <algorithm>
#include <tuple>

namespace window_ingress::detection {

CandidateTrace traceOf(const ScoredCandidate& rival, RejectReason reason, double value, double limit) {
  return {rival.quad,
          rival.candidate.source,
          reason,
          value,
          limit,
          rival.score,
          rival.appearance.has_value(),
          rival.appearance ? rival.appearance->distance : 0.0,
          rival.correlation.value_or(0.0),
          rival.proposal};
}

void sortByRank(std::vector<ScoredCandidate>& rivals) {
  // Equal ranks are ordered by place, so that the result does not depend on the previous order.
  const auto key = [](const ScoredCandidate& r) {
    return std::make_tuple(-r.rank(), r.quad[0].x(), r.quad[0].y(), r.quad[2].x(), r.quad[2].y());
  };
  std::sort(rivals.begin(), rivals.end(),
            [&key](const ScoredCandidate& a, const ScoredCandidate& b) { return key(a) < key(b); });
}

}  // namespace window_ingress::detection
