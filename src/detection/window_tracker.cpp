#include "window_ingress/detection/window_tracker.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "window_ingress/detection/border_quartet.hpp"
#include "window_ingress/detection/known_likeness.hpp"
#include "window_ingress/detection/picture_sequence.hpp"
#include "window_ingress/detection/reference_watch.hpp"
#include "window_ingress/detection/second_opinion.hpp"
#include "window_ingress/detection/target_identity.hpp"
#include "window_ingress/detection/track_picture.hpp"
#include "window_ingress/detection/track_trace.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kFoundSigmaPx = 0.3;  // of corners just found
constexpr double kQualityRate = 0.25;  // part of the certainty that a frame replaces
constexpr double kUnlikePart = 0.7;    // of the quality while the ring does not look like the reference
constexpr double kGivenWarp = 0.3;     // spread of the shape of a given prediction, of that of its place
constexpr double kBelievableSquares = 26.0;  // of a place that is given: 99.9 % of right ones are nearer
constexpr int kCompletionFrames = 10;        // between searches for a border that is in view and not found
constexpr double kSameWindow = 0.6;          // overlap of two loops of one window, of their union
constexpr double kVariantRadiusPx = 4.0;     // reach of the fit of a candidate that the search passed over

}  // namespace

struct WindowTracker::Impl {
  explicit Impl(const DetectorParams& p)
      : params(p),
        detector(p),
        refinement(p.refinement),
        pictures(p.track.max_gap_sec),
        reference(p),
        motion(),
        quartet(p.track, p.refinement),
        identity(p.track),
        likeness(p.track),
        opinion(p.track) {}

  void begin(const TrackInput& input);
  void predict(const TrackInput& input);
  QuadSpread spread() const;
  bool follow(const TrackInput& input);
  void watch(const TrackInput& input);
  std::optional<WindowObservation> search(const TrackInput& input);
  std::optional<WindowObservation> amongOthers(const TrackInput& input, const WindowObservation& found);
  void take(const TrackInput& input, WindowObservation& found, bool is_same);
  void refuse(RejectReason reason, const std::string& detail) {
    has_own_trace = true;
    traceRefused(detector.trace(), reason, detail, own_trace);
  }
  std::optional<WindowObservation> complete(const TrackInput& input);
  std::optional<WindowObservation> askSearch(const TrackInput& input);
  bool surrounds(const TrackInput& input);
  void forgetTrack() {
    identity.forget();
    has_motion = tracking = false;
  }
  void forget() {
    forgetTrack();
    pictures.forget();
  }

  DetectorParams params;
  WindowDetector detector;
  BorderRefinement refinement;
  PictureSequence pictures;
  ReferenceWatch reference;
  QuadMotion motion;
  BorderQuartet quartet;
  TargetIdentity identity;
  KnownLikeness likeness;
  SecondOpinion opinion;
  WindowObservation window;  // as followed last
  DetectionTrace own_trace;  // where the search's does not tell what happened
  double certainty = 0.0;
  int frames_to_completion = 0;
  bool tracking = false, has_motion = false, place_given = false, has_own_trace = false;
};

void WindowTracker::Impl::begin(const TrackInput& input) {
  if (!pictures.take(input)) forgetTrack();
  if (has_motion) predict(input);
}

QuadSpread WindowTracker::Impl::spread() const {
  const double side = sizeOf(motion.quad()), elapsed_sec = pictures.elapsedSec();
  const double place = pictures.turn() ? params.track.turn_known : params.track.turn;
  return {place * pictures.longerSide() * elapsed_sec, params.track.reshape * side * elapsed_sec,
          params.track.warp * side * elapsed_sec};
}

void WindowTracker::Impl::predict(const TrackInput& input) {
  motion.predict(pictures.turn().value_or(Eigen::Matrix3d::Identity()), pictures.elapsedSec(), spread());
  place_given =
      input.predicted && geometry::isFinite(*input.predicted) && geometry::isConvex(*input.predicted);
  if (!place_given) return;
  const double sigma_px = params.track.given_sigma * pictures.longerSide();
  const double most = tracking ? kBelievableSquares : std::numeric_limits<double>::infinity();
  place_given = motion.foretell(undistorted(*input.predicted, pictures.lens()),
                                {sigma_px, sigma_px, kGivenWarp * sigma_px}, most);
}

bool WindowTracker::Impl::follow(const TrackInput& input) {
  const bool found = quartet.follow(input.image, pictures.lens(), motion);
  const double quality = found ? quartet.quality() * (reference.isUnlike() ? kUnlikePart : 1.0) : 0.0;
  certainty += kQualityRate * (quality - certainty);
  if (!found || certainty < params.track.min_certainty) return false;
  motion.settle(pictures.elapsedSec());
  quartet.keep(input.image, pictures.lens(), motion.quad());
  quartet.describe(input.image, pictures.lens(), motion, window);
  identity.follow(input.stamp_sec);
  window.stamp_sec = input.stamp_sec;
  window.target_id = identity.id();
  watch(input);
  window.score = std::clamp(certainty, 0.0, 1.0);
  return true;
}

void WindowTracker::Impl::watch(const TrackInput& input) {
  if (quartet.inView() < 4) return;
  if (!reference.look(input, distorted(motion.quad(), pictures.lens()), window)) opinion.doubt();
  if (reference.hasAgreed() && opinion.isConfirmed() && certainty > params.track.adapt_certainty &&
      quartet.fitted() == 4)
    reference.adapt(input, window);
  if (reference.hasCompared() && opinion.isConfirmed()) likeness.note(window.bhattacharyya, input.stamp_sec);
}

// The search's window becomes the one that is own_trace.
void WindowTracker::Impl::take(const TrackInput& input, WindowObservation& found, bool is_same) {
  const Quadrilateral quad = undistorted(found.corners, pictures.lens());
  identity.found(is_same, input.stamp_sec);
  if (is_same)
    opinion.restart(), reference.restart();
  else
    opinion.start(), reference.start();
  found.target_id = identity.id();
  motion.start(quad, kFoundSigmaPx);
  quartet.learn(input.image, pictures.lens(), quad);
  certainty = std::max(found.score, 2.0 * params.track.min_certainty);
  window = found;
  tracking = has_motion = true;
}

// A window that the search passed over for a better one, where the old one must be; another loop of the one
// that it found says that this is the old one.
std::optional<WindowObservation> WindowTracker::Impl::amongOthers(const TrackInput& input,
                                                                  const WindowObservation& found) {
  for (const CandidateTrace& other : detector.trace().candidates) {
    if (other.reject != RejectReason::kOutscored ||
        !identity.isSame(undistorted(other.quad, pictures.lens()), motion.quad()))
      continue;
    if (geometry::intersectionOverUnion(other.quad, found.corners) > kSameWindow) return found;
    const auto borders = refinement.run(input.image, {other.quad, kVariantRadiusPx}, input.camera);
    if (!borders) continue;
    return observationOf(other, *borders, input.stamp_sec);
  }
  return std::nullopt;
}

std::optional<WindowObservation> WindowTracker::Impl::search(const TrackInput& input) {
  has_own_trace = false;
  auto found = detector.detect(input.image, input.stamp_sec, input.camera);
  if (!found) return std::nullopt;
  const bool remembers = has_motion && identity.remembers(input.stamp_sec, place_given);
  bool is_same = remembers && identity.isSame(undistorted(found->corners, pictures.lens()), motion.quad());
  if (remembers && !is_same) {
    if (auto other = amongOthers(input, *found)) found = other, is_same = true;
  }
  if (remembers && !is_same && identity.settled()) {
    refuse(RejectReason::kOutscored, "another window is in view; the one that was followed is waited for");
    return std::nullopt;
  }
  if (found->has_appearance && !likeness.allows(found->bhattacharyya, input.stamp_sec)) {
    refuse(RejectReason::kAppearance, "less like the reference than the target was");
    return std::nullopt;
  }
  take(input, *found, is_same);
  return found;
}

// Three of four borders in view: a search may tell the fourth. Its answer counts if it is the same border.
std::optional<WindowObservation> WindowTracker::Impl::complete(const TrackInput& input) {
  if (quartet.inView() < 4 || quartet.fitted() == 4) {
    frames_to_completion = 0;
    return std::nullopt;
  }
  if (--frames_to_completion > 0) return std::nullopt;
  frames_to_completion = kCompletionFrames;
  auto found = detector.detect(input.image, input.stamp_sec, input.camera);
  if (!found) return std::nullopt;
  const Quadrilateral seen = undistorted(found->corners, pictures.lens()), expected = motion.quad();
  const double limit_px = 2.0 * params.track.reach * pictures.longerSide();
  if (!geometry::isFinite(expected) || !(furthestCorner(seen, expected) < limit_px)) return std::nullopt;
  has_own_trace = false;
  take(input, *found, true);
  return found;
}

// While a track is new or doubtful: the search's answer, if it is to be followed in its place.
std::optional<WindowObservation> WindowTracker::Impl::askSearch(const TrackInput& input) {
  if (quartet.inView() < 4 || !opinion.isDue()) return std::nullopt;
  auto found = detector.detect(input.image, input.stamp_sec, input.camera);
  std::optional<Quadrilateral> searched;
  if (found) searched = undistorted(found->corners, pictures.lens());
  if (!opinion.prefers(searched, motion.quad())) return std::nullopt;
  has_own_trace = false;
  take(input, *found, identity.isSame(*searched, motion.quad()));
  return found;
}

// So near that no two sides are in view: the window is where it must be, for a while.
bool WindowTracker::Impl::surrounds(const TrackInput& input) {
  if (quartet.inView() >= 2 || !identity.settled() || !identity.remembers(input.stamp_sec, place_given) ||
      !geometry::contains(motion.quad(), {0.5 * pictures.size().width, 0.5 * pictures.size().height}))
    return false;
  refuse(RejectReason::kBorder,
         std::to_string(quartet.inView()) + " of 4 sides in view: the picture lies within the window");
  own_trace.candidates.clear();
  return true;
}

WindowTracker::WindowTracker(const DetectorParams& params) : impl_(std::make_unique<Impl>(params)) {}
WindowTracker::~WindowTracker() = default;

void WindowTracker::setParams(const DetectorParams& params) {
  impl_->detector.setParams(params);
  impl_->params = params;
  impl_->refinement = BorderRefinement(params.refinement);
  impl_->quartet = BorderQuartet(params.track, params.refinement);
  const TargetIdentity before = impl_->identity;
  impl_->identity = TargetIdentity(params.track, before.id());
  impl_->opinion = SecondOpinion(params.track);
  impl_->reference.setParams(params);
  impl_->pictures = PictureSequence(params.track.max_gap_sec);
  impl_->likeness = KnownLikeness(params.track);
  impl_->forget();
}

void WindowTracker::setReference(const ReferenceAppearance& reference) {
  const auto shared = std::make_shared<ReferenceAppearance>(reference);
  impl_->detector.shareReference(shared);
  impl_->reference.setReference(shared);
  impl_->likeness.forget();
  impl_->forget();
}

void WindowTracker::clearReference() {
  impl_->reference.setReference(nullptr);
  impl_->detector.clearReference();
  impl_->likeness.forget();
  impl_->forget();
}

void WindowTracker::setWatch(StageWatch* watch) { impl_->detector.setWatch(watch); }

void WindowTracker::reset() {
  impl_->likeness.forget();
  impl_->forget();
}

std::optional<WindowObservation> WindowTracker::update(const TrackInput& input) {
  if (!isPicture(input.image) || !std::isfinite(input.stamp_sec)) {
    impl_->forget();
    impl_->has_own_trace = false;
    return impl_->detector.detect(input.image, input.stamp_sec, input.camera);
  }
  impl_->begin(input);
  const bool followed = impl_->tracking && impl_->follow(input);
  done(impl_->detector.watch(), Stage::kTrack);
  if (followed) {
    impl_->has_own_trace = true;
    traceFollowed(impl_->window, impl_->own_trace);
    if (auto whole = impl_->complete(input)) return whole;
    if (auto other = impl_->askSearch(input)) return other;
    return impl_->window;
  }
  if (impl_->tracking && impl_->surrounds(input)) return std::nullopt;
  impl_->tracking = false;
  return impl_->search(input);
}

const DetectionTrace& WindowTracker::trace() const {
  return impl_->has_own_trace ? impl_->own_trace : impl_->detector.trace();
}

double WindowTracker::referenceDrift() const { return impl_->reference.drift(); }

bool WindowTracker::tracking() const { return impl_->tracking; }

}  // namespace window_ingress::detection
