#include "detection/candidates/candidate.hpp"

#include <algorithm>
#include <tuple>

namespace window_ingress::detection {

CandidateTrace traceOf(const ScoredCandidate& candidate, const Rejection& rejection) {
  CandidateTrace trace{candidate.quad,  candidate.found.source, rejection.reason,
                       rejection.value, rejection.limit,        candidate.score};
  trace.has_appearance = candidate.appearance.has_value();
  if (candidate.appearance) trace.bhattacharyya = candidate.appearance->distance;
  trace.correlation = candidate.correlation.value_or(0.0);
  trace.proposal = candidate.proposal;
  return trace;
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
