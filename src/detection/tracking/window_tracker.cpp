#include "window_ingress/detection/window_tracker.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "detection/tracking/window_tracker_impl.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kReshape = 0.25;        ///< unpredicted change of size and roll [window sides/s]
constexpr double kWarp = 0.08;           ///< unpredicted change of aspect, skew and keystone [window sides/s]
constexpr double kAdaptCertainty = 0.8;  ///< above this certainty the reference adapts to the light, 0 to 1
constexpr double kTurn = 0.12;           ///< unpredicted motion of place [longer image sides/s]
constexpr double kKnownTurn = 0.5;     ///< part of the unpredicted motion that remains with a known attitude
constexpr double kMinCertainty = 0.4;  // below it the track is lost, 0 to 1
constexpr double kQualityRate = 0.25;  // part of the certainty that one frame replaces
constexpr double kFoundSigmaPx = 0.3;  // of corners just found
constexpr double kUnlikePart = 0.7;    // factor of the quality while the ring does not match the reference
constexpr double kExpectedSigma = 0.01;  // of an expected window's place [longer image sides]
constexpr int kAlignEvery = 3;           // frames
constexpr int kCompletionFrames = 10;    // between searches for a missing border in view
constexpr int kElsewhereFrames = 5;      // after which a track away from the expected place is dropped

}  // namespace

void WindowTracker::Impl::begin(const TrackInput& input) {
  was_searched = false;
  if (!images.take(input)) forgetTrack();
  place_is_expected =
      input.expected && geometry::isFinite(*input.expected) && geometry::isConvex(*input.expected);
  if (place_is_expected) heedExpected(input);
  if (has_motion) predict();
}

// Keeps a track at the expected place; drops one elsewhere.
void WindowTracker::Impl::heedExpected(const TrackInput& input) {
  const geometry::Quadrilateral place = geometry::undistorted(*input.expected, images.lens());
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

// An attitude that jitters by more than the unpredicted motion is worse than none.
bool WindowTracker::Impl::knowsTurn() const {
  return images.turn() && images.turnSigmaPx() < kTurn * images.longerSide() * images.elapsedSec();
}

QuadSpread WindowTracker::Impl::spread() const {
  const double side = geometry::rootArea(motion.quad()), elapsed_sec = images.elapsedSec();
  const double unforeseen_px = images.longerSide() * elapsed_sec;
  const double place_px = knowsTurn() ? std::hypot(kKnownTurn * kTurn * unforeseen_px, images.turnSigmaPx())
                                      : kTurn * unforeseen_px;
  return {place_px, kReshape * side * elapsed_sec, kWarp * side * elapsed_sec};
}

void WindowTracker::Impl::predict() {
  motion.predict(knowsTurn() ? *images.turn() : Eigen::Matrix3d(Eigen::Matrix3d::Identity()),
                 images.elapsedSec(), spread());
}

bool WindowTracker::Impl::follow(const TrackInput& input) {
  const bool found = quad_tracker.follow(input.image, images.lens(), motion);
  const double quality = found ? quad_tracker.quality() * (reference.isUnlike() ? kUnlikePart : 1.0) : 0.0;
  certainty += kQualityRate * (quality - certainty);
  if (!found || certainty < kMinCertainty) return false;
  motion.settle(images.elapsedSec());
  quad_tracker.keep(motion.quad());
  quad_tracker.describe(input.image, images.lens(), motion, window);
  memory.follow(input.stamp_sec);
  window.stamp_sec = input.stamp_sec;
  window.target_id = memory.id();
  watch(input);
  window.score = std::clamp(certainty, 0.0, 1.0);
  return true;
}

// Tracks the window of the search.
void WindowTracker::Impl::take(const TrackInput& input, WindowObservation& found, bool is_same) {
  const geometry::Quadrilateral quad = geometry::undistorted(found.corners, images.lens());
  memory.found(is_same, input.stamp_sec);
  if (is_same)
    recheck.restart(), reference.restart();
  else
    recheck.start(), reference.start();
  found.target_id = memory.id();
  motion.start(quad, kFoundSigmaPx);
  quad_tracker.learn(input.image, images.lens(), quad, input.camera && reference.isKnown());
  frames_to_alignment = 0;
  certainty = std::max(found.score, 2.0 * kMinCertainty);
  window = found;
  tracking = has_motion = true;
}

void WindowTracker::Impl::watch(const TrackInput& input) {
  if (quad_tracker.inView() < 4) return;
  if (!reference.look(input, window)) recheck.doubt();
  if (reference.hasAgreed() && recheck.isConfirmed() && certainty > kAdaptCertainty &&
      quad_tracker.fitted() == 4)
    reference.adapt(input, window);
  if (reference.hasCompared() && recheck.isConfirmed())
    appearance_gate.note(window.bhattacharyya, input.stamp_sec);
}

// The tracker may follow an edge beside the border, for example the back edge of a reveal. The opening's
// surroundings give the true border. From then on the edges there are tracked, or the distance to the tracked
// ones is kept.
void WindowTracker::Impl::realign(const TrackInput& input) {
  if (--frames_to_alignment > 0 || quad_tracker.inView() < 4) return;
  frames_to_alignment = kAlignEvery;
  const auto borders =
      detector.bordersNear(geometry::distorted(motion.quad(), images.lens()), input.image, input.camera);
  if (!borders) return;
  if (!quad_tracker.realign(input.image, images.lens(), *borders, motion)) return;
  window.corners = borders->corners;
  window.corner_visible.fill(true);
  window.corner_covariance = borders->corner_covariance;
  window.edges = borders->edges;
}

// True if the vehicle is so near that fewer than two sides are in view. The last place is kept for a while.
bool WindowTracker::Impl::surrounds(const TrackInput& input) {
  if (quad_tracker.inView() >= 2 || !memory.settled() || !memory.remembers(input.stamp_sec) ||
      !geometry::contains(motion.quad(), {0.5 * images.size().width, 0.5 * images.size().height}))
    return false;
  refuse(RejectReason::kBorder,
         std::to_string(quad_tracker.inView()) + " of 4 sides in view: the image lies within the window");
  own_trace.candidates.clear();
  return true;
}

// If a border in view is missing, a search may find it. Its answer counts if it is the same window.
std::optional<WindowObservation> WindowTracker::Impl::complete(const TrackInput& input) {
  if (quad_tracker.inView() < 4 || quad_tracker.fitted() == 4) {
    frames_to_completion = 0;
    return std::nullopt;
  }
  if (--frames_to_completion > 0) return std::nullopt;
  frames_to_completion = kCompletionFrames;
  auto found = lookForWindow(input);
  if (!found) return std::nullopt;
  const geometry::Quadrilateral seen = geometry::undistorted(found->corners, images.lens()),
                                expected = motion.quad();
  const double limit_px = 2.0 * EdgeTracker::kReach * images.longerSide();
  if (!geometry::isFinite(expected) || !(geometry::furthestCorner(seen, expected) < limit_px))
    return std::nullopt;
  has_own_trace = false;
  take(input, *found, true);
  return found;
}

// For a new or doubtful track: the search's answer, if it replaces the track.
std::optional<WindowObservation> WindowTracker::Impl::askSearch(const TrackInput& input) {
  if (quad_tracker.inView() < 4 || !recheck.isDue()) return std::nullopt;
  auto found = lookForWindow(input);
  std::optional<geometry::Quadrilateral> searched;
  if (found && place_is_expected &&
      !memory.isSame(geometry::undistorted(found->corners, images.lens()), motion.quad()))
    found = amongOthers(input, *found);
  if (found) searched = geometry::undistorted(found->corners, images.lens());
  if (!recheck.prefers(searched, motion.quad())) return std::nullopt;
  has_own_trace = false;
  take(input, *found, memory.isSame(*searched, motion.quad()));
  return found;
}

std::optional<WindowObservation> WindowTracker::Impl::updated(const TrackInput& input) {
  begin(input);
  const bool followed = tracking && follow(input);
  done(detector.timer(), Stage::kTrack);
  if (followed) {
    realign(input);
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

void WindowTracker::Impl::survey(const TrackInput& input, const std::optional<WindowObservation>& target) {
  const double since_sec = input.stamp_sec - searched_sec;
  const bool is_due =
      params.track.survey_sec > 0.0 && !(since_sec < params.track.survey_sec && since_sec >= 0.0);
  if (tracking && !was_searched && is_due && quad_tracker.inView() == 4) lookForWindow(input);
  static const DetectionTrace kNothing;
  windowsSeen(was_searched ? detector.trace() : kNothing, target, windows);
}

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
  impl_->appearance_gate = AppearanceGate();
  impl_->forget();
}

void WindowTracker::setReference(const ReferenceAppearance& reference) {
  const auto shared = std::make_shared<ReferenceAppearance>(reference);
  impl_->detector.shareReference(shared);
  impl_->reference.setReference(shared);
  impl_->appearance_gate.forget();
  impl_->forget();
}

void WindowTracker::setTimer(StageTimer* timer) { impl_->detector.setTimer(timer); }

void WindowTracker::reset() {
  impl_->appearance_gate.forget();
  impl_->forget();
}

std::optional<WindowObservation> WindowTracker::update(const TrackInput& input) {
  if (!isUsableImage(input.image) || !std::isfinite(input.stamp_sec)) {
    impl_->forget();
    impl_->has_own_trace = false;
    impl_->windows.clear();
    return impl_->detector.detect(input.image, input.stamp_sec, input.camera);
  }
  auto window = impl_->updated(input);
  impl_->survey(input, window);
  return window;
}

const std::vector<SeenWindow>& WindowTracker::windows() const { return impl_->windows; }

const DetectionTrace& WindowTracker::trace() const {
  return impl_->has_own_trace ? impl_->own_trace : impl_->detector.trace();
}

bool WindowTracker::tracking() const { return impl_->tracking; }

}  // namespace window_ingress::detection
