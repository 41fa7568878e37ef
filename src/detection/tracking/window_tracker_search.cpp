#include <algorithm>

#include "detection/quads.hpp"
#include "detection/tracking/window_tracker_impl.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kFoundSigmaPx = 0.3;     // of corners just found
constexpr int kCompletionFrames = 10;     // between searches for a border that is in view and not found
constexpr double kVariantRadiusPx = 4.0;  // reach of the fit of a candidate that the search passed over

}  // namespace

std::optional<WindowObservation> WindowTracker::Impl::lookForWindow(const TrackInput& input) {
  was_searched = true;
  searched_sec = input.stamp_sec;
  return detector.detect(input.image, input.stamp_sec, input.camera);
}

void WindowTracker::Impl::survey(const TrackInput& input, const std::optional<WindowObservation>& target) {
  const double since_sec = input.stamp_sec - searched_sec;
  const bool is_due =
      params.track.survey_sec > 0.0 && !(since_sec < params.track.survey_sec && since_sec >= 0.0);
  if (tracking && !was_searched && is_due && quad_tracker.inView() == 4) lookForWindow(input);
  static const DetectionTrace kNothing;
  windowsSeen(was_searched ? detector.trace() : kNothing, target, windows);
}

// The search's window becomes the one that is own_trace.
void WindowTracker::Impl::take(const TrackInput& input, WindowObservation& found, bool is_same) {
  const Quadrilateral quad = undistorted(found.corners, images.lens());
  identity.found(is_same, input.stamp_sec);
  if (is_same)
    confirmation.restart(), reference.restart();
  else
    confirmation.start(), reference.start();
  found.target_id = identity.id();
  motion.start(quad, kFoundSigmaPx);
  quad_tracker.learn(input.image, images.lens(), quad, input.camera && reference.isKnown());
  frames_to_alignment = 0;
  certainty = std::max(found.score, 2.0 * kMinCertainty);
  window = found;
  tracking = has_motion = true;
}

// A window that the search passed over for a better one, where the old one must be, of several the best;
// another loop of the one that it found says that this is the old one.
std::optional<WindowObservation> WindowTracker::Impl::amongOthers(const TrackInput& input,
                                                                  const WindowObservation& found) {
  std::vector<const CandidateTrace*> others;
  for (const CandidateTrace& other : detector.trace().candidates)
    if (other.reject == RejectReason::kOutscored &&
        identity.isSame(undistorted(other.quad, images.lens()), motion.quad()))
      others.push_back(&other);
  std::stable_sort(others.begin(), others.end(),
                   [](const auto* a, const auto* b) { return a->score > b->score; });
  for (const CandidateTrace* other : others) {
    if (Sameness(other->quad).sameWindow(found.corners)) return found;
    const auto borders = refinement.run(input.image, {other->quad, kVariantRadiusPx}, input.camera);
    if (borders) return observationOf(*other, *borders, input.stamp_sec);
  }
  return std::nullopt;
}

std::optional<WindowObservation> WindowTracker::Impl::search(const TrackInput& input) {
  has_own_trace = false;
  auto found = lookForWindow(input);
  if (!found) return std::nullopt;
  const bool remembers = has_motion && identity.remembers(input.stamp_sec);
  bool is_same = remembers && identity.isSame(undistorted(found->corners, images.lens()), motion.quad());
  if (remembers && !is_same) {
    if (auto other = amongOthers(input, *found)) found = other, is_same = true;
  }
  if (remembers && !is_same && identity.settled()) {
    refuse(RejectReason::kOutscored, "another window is in view; the one that was followed is waited for");
    return std::nullopt;
  }
  if (found->has_appearance && !appearance_gate.allows(found->bhattacharyya, input.stamp_sec)) {
    refuse(RejectReason::kAppearance, "less like the reference than the target was");
    return std::nullopt;
  }
  take(input, *found, is_same);
  return found;
}

// Three of four borders in view: a search may tell the fourth. Its answer counts if it is the same border.
std::optional<WindowObservation> WindowTracker::Impl::complete(const TrackInput& input) {
  if (quad_tracker.inView() < 4 || quad_tracker.fitted() == 4) {
    frames_to_completion = 0;
    return std::nullopt;
  }
  if (--frames_to_completion > 0) return std::nullopt;
  frames_to_completion = kCompletionFrames;
  auto found = lookForWindow(input);
  if (!found) return std::nullopt;
  const Quadrilateral seen = undistorted(found->corners, images.lens()), expected = motion.quad();
  const double limit_px = 2.0 * EdgeTracker::kReach * images.longerSide();
  if (!geometry::isFinite(expected) || !(furthestCorner(seen, expected) < limit_px)) return std::nullopt;
  has_own_trace = false;
  take(input, *found, true);
  return found;
}

// While a track is new or doubtful: the search's answer, if it is to be followed in its place.
std::optional<WindowObservation> WindowTracker::Impl::askSearch(const TrackInput& input) {
  if (quad_tracker.inView() < 4 || !confirmation.isDue()) return std::nullopt;
  auto found = lookForWindow(input);
  std::optional<Quadrilateral> searched;
  if (found && place_is_expected &&
      !identity.isSame(undistorted(found->corners, images.lens()), motion.quad()))
    found = amongOthers(input, *found);
  if (found) searched = undistorted(found->corners, images.lens());
  if (!confirmation.prefers(searched, motion.quad())) return std::nullopt;
  has_own_trace = false;
  take(input, *found, identity.isSame(*searched, motion.quad()));
  return found;
}

}  // namespace window_ingress::detection
