#include "window_ingress/detection/seen_windows.hpp"

#include <algorithm>
#include <tuple>

namespace window_ingress::detection {
namespace {

constexpr std::size_t kMaxWindows = 12;
constexpr double kSameSeen = 0.15;  // overlap of two loops, over their union

bool looksOtherwise(RejectReason reason) {
  return reason == RejectReason::kAppearance || reason == RejectReason::kOtherAspect ||
         reason == RejectReason::kOtherFrame || reason == RejectReason::kUnlike;
}

bool isWindow(const CandidateTrace& candidate) {
  return candidate.reject == RejectReason::kNone || candidate.reject == RejectReason::kOutscored ||
         looksOtherwise(candidate.reject);
}

bool overlaps(const SeenWindow& a, const SeenWindow& b) {
  return geometry::intersectionOverUnion(a.corners, b.corners) > kSameSeen ||
         geometry::contains(a.corners, geometry::centroid(b.corners)) ||
         geometry::contains(b.corners, geometry::centroid(a.corners));
}

}  // namespace

void windowsSeen(const DetectionTrace& trace, const std::optional<WindowObservation>& target,
                 std::vector<SeenWindow>& windows) {
  windows.clear();
  if (target && target->whole())
    windows.push_back(
        {target->corners, target->score, target->has_appearance, target->bhattacharyya, true, true});
  std::vector<const CandidateTrace*> fair;
  for (const CandidateTrace& candidate : trace.candidates)
    if (isWindow(candidate) && geometry::isConvex(candidate.quad)) fair.push_back(&candidate);
  const auto key = [](const CandidateTrace* c) {
    return std::make_tuple(looksOtherwise(c->reject), -c->score, c->quad[0].x(), c->quad[0].y());
  };
  std::sort(fair.begin(), fair.end(), [&](const auto* a, const auto* b) { return key(a) < key(b); });
  for (const CandidateTrace* candidate : fair) {
    if (windows.size() == kMaxWindows) break;
    const SeenWindow seen{candidate->quad,
                          candidate->score,
                          candidate->has_appearance,
                          candidate->bhattacharyya,
                          false,
                          !looksOtherwise(candidate->reject)};
    const bool is_known = std::any_of(windows.begin(), windows.end(),
                                      [&](const SeenWindow& better) { return overlaps(better, seen); });
    if (!is_known) windows.push_back(seen);
  }
}

}  // namespace window_ingress::detection
