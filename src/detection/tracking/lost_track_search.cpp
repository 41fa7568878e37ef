/// The tracker's search for an untracked window: a new one, or the one that was lost.
#include <algorithm>

#include "detection/quad_sameness.hpp"
#include "detection/tracking/window_tracker_impl.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kVariantRadiusPx = 4.0;  // search reach when fitting a candidate that the search passed over

}  // namespace

std::optional<WindowObservation> WindowTracker::Impl::lookForWindow(const TrackInput& input) {
  was_searched = true;
  searched_sec = input.stamp_sec;
  return detector.detect(input.image, input.stamp_sec, input.camera);
}

// The best window at the expected place that the search passed over for a better one. If it is another loop
// of the found window, the found window is the old one.
std::optional<WindowObservation> WindowTracker::Impl::amongOthers(const TrackInput& input,
                                                                  const WindowObservation& found) {
  std::vector<const CandidateTrace*> others;
  for (const CandidateTrace& other : detector.trace().candidates)
    if (other.reject == RejectReason::kOutscored &&
        memory.isSame(geometry::undistorted(other.quad, images.lens()), motion.quad()))
      others.push_back(&other);
  std::stable_sort(others.begin(), others.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });
  for (const CandidateTrace* other : others) {
    if (Sameness(other->quad).sameWindow(found.corners)) return found;
    const auto borders = refineBorders(input.image, {other->quad, kVariantRadiusPx}, input.camera);
    if (borders) return observationOf(*other, *borders, input.stamp_sec);
  }
  return std::nullopt;
}

std::optional<WindowObservation> WindowTracker::Impl::search(const TrackInput& input) {
  has_own_trace = false;
  auto found = lookForWindow(input);
  if (!found) return std::nullopt;
  const bool remembers = has_motion && memory.remembers(input.stamp_sec);
  bool is_same =
      remembers && memory.isSame(geometry::undistorted(found->corners, images.lens()), motion.quad());
  if (remembers && !is_same) {
    if (auto other = amongOthers(input, *found)) found = other, is_same = true;
  }
  if (remembers && !is_same && memory.settled()) {
    refuse(RejectReason::kOutscored, "another window is in view; waiting for the tracked one");
    return std::nullopt;
  }
  if (found->has_appearance && !appearance_gate.allows(found->bhattacharyya, input.stamp_sec)) {
    refuse(RejectReason::kAppearance, "less like the reference than the target was");
    return std::nullopt;
  }
  take(input, *found, is_same);
  return found;
}

}  // namespace window_ingress::detection
