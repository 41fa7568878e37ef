#include "window_ingress/detection/window_tracker.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <string>

#include "detection/tracking/appearance_monitor.hpp"
#include "detection/tracking/image_sequence.hpp"
#include "detection/tracking/quad_tracker.hpp"
#include "detection/tracking/track_memory.hpp"
#include "detection/tracking/track_recheck.hpp"
#include "window_ingress/detection/window_detector.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kReshape = 0.25;        // unpredicted change of size and roll [window sides/s]
constexpr double kWarp = 0.08;           // unpredicted change of aspect, skew and keystone [window sides/s]
constexpr double kAdaptCertainty = 0.8;  // above this certainty the reference adapts to the light, 0 to 1
constexpr double kTurn = 0.12;           // unpredicted motion of place [longer image sides/s]
constexpr double kKnownTurn = 0.5;       // part of the unpredicted motion that remains with a known attitude
constexpr double kMinCertainty = 0.4;    // below it the track is lost, 0 to 1
constexpr double kQualityRate = 0.25;    // part of the certainty that one frame replaces
constexpr double kFoundSigmaPx = 0.3;    // of corners just found
constexpr double kUnlikePart = 0.7;      // factor of the quality while the ring does not match the reference
constexpr double kExpectedSigma = 0.01;  // of an expected window's place [longer image sides]
constexpr int kAlignEvery = 3;           // frames
constexpr int kCompletionFrames = 10;    // between searches for a missing border in view
constexpr int kElsewhereFrames = 5;      // after which a track away from the expected place is dropped

}  // namespace

struct WindowTracker::Impl {
  explicit Impl(const DetectorParams& p) : params(p) {}

  Quadrilateral undistorted(const Quadrilateral& quad) const {
    return geometry::undistorted(quad, images.lens());
  }
  LensImage viewOf(const TrackInput& input) const { return {input.image, images.lens()}; }
  bool isAtTrack(const Quadrilateral& seen) const { return memory.isSame(undistorted(seen), motion.quad()); }

  void forgetTrack() {
    memory.forget();
    has_motion = tracking = false;
  }
  void forget() {
    forgetTrack();
    images.forget();
  }

  std::optional<WindowObservation> update(const TrackInput& input) {
    was_searched = false;
    if (!images.take(input)) forgetTrack();
    place_is_expected =
        input.expected && geometry::isFinite(*input.expected) && geometry::isConvex(*input.expected);
    if (place_is_expected) heedExpected(input);
    if (has_motion) predict();
    const bool followed = tracking && follow(input);
    if (followed) realign(input);
    done(detector.timer(), Stage::kTrack);
    if (followed) {
      has_own_trace = true;
      traceFollowed(window, own_trace);
      if (auto whole = complete(input)) return whole;
      if (auto other = askSearch(input)) return other;
      return window;
    }
    if (tracking && surrounds(input)) return std::nullopt;
    tracking = false;
    return search(input);
  }

  // Keeps a track at the expected place; drops one elsewhere.
  void heedExpected(const TrackInput& input) {
    const Quadrilateral place = undistorted(*input.expected);
    if (tracking) {
      frames_elsewhere = memory.isSame(motion.quad(), place) ? 0 : frames_elsewhere + 1;
      if (frames_elsewhere < kElsewhereFrames) return;
      forgetTrack();
      memory.change();
    }
    frames_elsewhere = 0;
    memory.expect(input.stamp_sec);
    motion.start(place, kExpectedSigma * images.longerSide());
    has_motion = true;
  }

  void predict() {
    const double elapsed_sec = images.elapsedSec(), side_px = geometry::rootArea(motion.quad());
    const double unpredicted_px = kTurn * (images.longerSide() * elapsed_sec);
    // An attitude that jitters by more than the unpredicted motion is worse than none.
    const bool knows_turn = images.turn() && images.turnSigmaPx() < unpredicted_px;
    const double place_px =
        knows_turn ? std::hypot(kKnownTurn * unpredicted_px, images.turnSigmaPx()) : unpredicted_px;
    motion.predict(knows_turn ? *images.turn() : Eigen::Matrix3d(Eigen::Matrix3d::Identity()), elapsed_sec,
                   {place_px, kReshape * side_px * elapsed_sec, kWarp * side_px * elapsed_sec});
  }

  bool follow(const TrackInput& input) {
    const bool found = quad_tracker.follow(viewOf(input), motion);
    const double quality = found ? quad_tracker.quality() * (reference.isUnlike() ? kUnlikePart : 1.0) : 0.0;
    certainty += kQualityRate * (quality - certainty);
    if (!found || certainty < kMinCertainty) return false;
    motion.settle(images.elapsedSec());
    quad_tracker.keep(motion.quad());
    quad_tracker.describe(viewOf(input), motion, window);
    memory.follow(input.stamp_sec);
    window.stamp_sec = input.stamp_sec;
    window.target_id = memory.id();
    if (quad_tracker.inView() == 4) {
      const bool is_certain = certainty > kAdaptCertainty && quad_tracker.fitted() == 4;
      if (!reference.look(input, window, recheck.isConfirmed(), is_certain)) recheck.doubt();
    }
    window.score = std::clamp(certainty, 0.0, 1.0);
    return true;
  }

  // The tracker may follow an edge beside the border, for example the back edge of a reveal. The opening's
  // surroundings give the true border. From then on the edges there are tracked, or the distance to the
  // tracked ones is kept.
  void realign(const TrackInput& input) {
    if (--frames_to_alignment > 0 || quad_tracker.inView() < 4) return;
    frames_to_alignment = kAlignEvery;
    const auto borders =
        detector.bordersNear(geometry::distorted(motion.quad(), images.lens()), input.image, input.camera);
    if (!borders || !quad_tracker.realign(viewOf(input), *borders, motion)) return;
    window.corners = borders->corners;
    window.corner_visible.fill(true);
    window.corner_covariance = borders->corner_covariance;
    window.edges = borders->edges;
  }

  std::optional<WindowObservation> lookForWindow(const TrackInput& input) {
    if (!was_searched) found_by_search = detector.detect(input.image, input.stamp_sec, input.camera);
    was_searched = true;
    searched_sec = input.stamp_sec;
    return found_by_search;
  }

  // Tracks the window of the search.
  std::optional<WindowObservation> take(const TrackInput& input, const WindowObservation& found,
                                        bool is_same) {
    const Quadrilateral quad = undistorted(found.corners);
    memory.found(is_same, input.stamp_sec);
    is_same ? recheck.restart() : recheck.start();
    is_same ? reference.restart() : reference.start();
    motion.start(quad, kFoundSigmaPx);
    quad_tracker.learn(viewOf(input), quad, input.camera && reference.isKnown());
    frames_to_alignment = frames_elsewhere = 0;
    certainty = std::max(found.score, 2.0 * kMinCertainty);
    window = found;
    window.target_id = memory.id();
    tracking = has_motion = true;
    has_own_trace = false;
    return window;
  }

  // Rejects the window of the search.
  std::nullopt_t refuse(RejectReason reason, const std::string& detail) {
    has_own_trace = true;
    own_trace = detector.trace();
    own_trace.target = -1;
    own_trace.outcome = reason;
    own_trace.detail = detail;
    return std::nullopt;
  }

  // If a border in view is missing, a search may find it. Its answer counts if it is the same window.
  std::optional<WindowObservation> complete(const TrackInput& input) {
    const bool is_missing = quad_tracker.inView() == 4 && quad_tracker.fitted() < 4;
    frames_to_completion = is_missing ? frames_to_completion - 1 : 0;
    if (!is_missing || frames_to_completion > 0) return std::nullopt;
    frames_to_completion = kCompletionFrames;
    const auto found = lookForWindow(input);
    const double limit_px = 2.0 * EdgeTracker::kReach * images.longerSide();
    if (!found || !geometry::isFinite(motion.quad()) ||
        !(geometry::furthestCorner(undistorted(found->corners), motion.quad()) < limit_px))
      return std::nullopt;
    return take(input, *found, true);
  }

  // For a new or doubtful track: the search's answer, if it replaces the track.
  std::optional<WindowObservation> askSearch(const TrackInput& input) {
    if (quad_tracker.inView() < 4 || !recheck.isDue()) return std::nullopt;
    auto found = lookForWindow(input);
    if (found && place_is_expected && !isAtTrack(found->corners)) found = passedOver(input, *found);
    std::optional<Quadrilateral> searched;
    if (found) searched = undistorted(found->corners);
    if (!recheck.prefers(searched, motion.quad())) return std::nullopt;
    return take(input, *found, memory.isSame(*searched, motion.quad()));
  }

  // The best window at the tracked place that the search passed over for a better one.
  std::optional<WindowObservation> passedOver(const TrackInput& input, const WindowObservation& found) {
    return detector.passedOver(
        found, [this](const Quadrilateral& quad) { return isAtTrack(quad); }, input.image, input.camera);
  }

  // Searches for a new window, or for the one that was lost.
  std::optional<WindowObservation> search(const TrackInput& input) {
    has_own_trace = false;
    auto found = lookForWindow(input);
    if (!found) return std::nullopt;
    const bool remembers = has_motion && memory.remembers(input.stamp_sec);
    bool is_same = remembers && isAtTrack(found->corners);
    if (remembers && !is_same)
      if (const auto other = passedOver(input, *found)) found = other, is_same = true;
    if (remembers && !is_same && memory.settled())
      return refuse(RejectReason::kOutscored, "another window is in view; waiting for the tracked one");
    if (!reference.allows(*found))
      return refuse(RejectReason::kAppearance, "less like the reference than the target was");
    return take(input, *found, is_same);
  }

  // True if the vehicle is so near that fewer than two sides are in view. The last place is kept for a while.
  bool surrounds(const TrackInput& input) {
    if (quad_tracker.inView() >= 2 || !memory.settled() || !memory.remembers(input.stamp_sec) ||
        !geometry::contains(motion.quad(), {0.5 * images.size().width, 0.5 * images.size().height}))
      return false;
    refuse(RejectReason::kBorder,
           std::to_string(quad_tracker.inView()) + " of 4 sides in view: the image lies within the window");
    own_trace.candidates.clear();
    return true;
  }

  void survey(const TrackInput& input, const std::optional<WindowObservation>& target) {
    const double since_sec = input.stamp_sec - searched_sec, every_sec = params.track.survey_sec;
    const bool is_due = every_sec > 0.0 && !(since_sec >= 0.0 && since_sec < every_sec);
    if (tracking && is_due && quad_tracker.inView() == 4) lookForWindow(input);
    static const DetectionTrace kNothing;
    windowsSeen(was_searched ? detector.trace() : kNothing, target, windows);
  }

  DetectorParams params;
  WindowDetector detector{params};
  ImageSequence images{params.track.max_gap_sec};
  AppearanceMonitor reference{params};
  QuadMotion motion;
  QuadTracker quad_tracker;
  TrackMemory memory{params.track};
  TrackRecheck recheck{params.track};
  WindowObservation window;  // as tracked last
  DetectionTrace own_trace;  // if the search's trace does not tell what happened
  double certainty = 0.0, searched_sec = 0.0;
  std::vector<SeenWindow> windows;
  std::optional<WindowObservation> found_by_search;  // in the last image searched; one search an image
  int frames_to_alignment = 0, frames_to_completion = 0, frames_elsewhere = 0;
  bool was_searched = false, place_is_expected = false;
  bool tracking = false, has_motion = false, has_own_trace = false;
};

WindowTracker::WindowTracker(const DetectorParams& params) : impl_(std::make_unique<Impl>(params)) {}
WindowTracker::~WindowTracker() = default;

void WindowTracker::setParams(const DetectorParams& params) {
  impl_->detector.setParams(params);
  impl_->params = params;
  impl_->quad_tracker = QuadTracker();
  impl_->memory = TrackMemory(params.track, impl_->memory.id());
  impl_->recheck = TrackRecheck(params.track);
  impl_->reference.setParams(params);
  impl_->images = ImageSequence(params.track.max_gap_sec);
  reset();
}

void WindowTracker::setReference(const ReferenceAppearance& reference) {
  const auto shared = std::make_shared<ReferenceAppearance>(reference);
  impl_->detector.shareReference(shared);
  impl_->reference.setReference(shared);
  reset();
}

void WindowTracker::reset() {
  impl_->reference.forget();
  impl_->forget();
}

std::optional<WindowObservation> WindowTracker::update(const TrackInput& input) {
  if (!isUsableImage(input.image) || !std::isfinite(input.stamp_sec)) {
    impl_->forget();
    impl_->has_own_trace = false;
    impl_->windows.clear();
    return impl_->detector.detect(input.image, input.stamp_sec, input.camera);
  }
  auto window = impl_->update(input);
  impl_->survey(input, window);
  return window;
}

void WindowTracker::setTimer(StageTimer* timer) { impl_->detector.setTimer(timer); }
bool WindowTracker::tracking() const { return impl_->tracking; }
const std::vector<SeenWindow>& WindowTracker::windows() const { return impl_->windows; }
const DetectionTrace& WindowTracker::trace() const {
  return impl_->has_own_trace ? impl_->own_trace : impl_->detector.trace();
}

}  // namespace window_ingress::detection
