#include "window_ingress/detection/window_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "window_ingress/detection/border_quartet.hpp"
#include "window_ingress/detection/reference_borders.hpp"
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
constexpr int kCompletionFrames = 10;  // between searches for a border that is in view and not found
constexpr double kSureWorth = 0.3;     // of the reference's borders, to say where they are
constexpr double kLeastStrayPx = 3.0, kStray = 0.03;  // of a corner from there; in the window's sizes
constexpr double kVariantRadiusPx = 4.0;  // reach of the fit of a candidate that the search passed over

}  // namespace

struct WindowTracker::Impl {
  explicit Impl(const DetectorParams& p)
      : params(p),
        detector(p),
        refinement(p.refinement),
        motion(),
        quartet(p.track, p.refinement),
        identity(p.track),
        opinion(p.track) {}

  bool isContinued(const TrackInput& input) const;
  void begin(const TrackInput& input);
  void predict(const TrackInput& input);
  Eigen::Matrix3d turn(const TrackInput& input) const;
  QuadSpread spread(const TrackInput& input, bool has_attitude) const;
  bool follow(const TrackInput& input);
  void compareRing(const TrackInput& input);
  bool strays(const TrackInput& input);
  std::optional<WindowObservation> search(const TrackInput& input);
  std::optional<WindowObservation> amongOthers(const TrackInput& input);
  void take(const TrackInput& input, WindowObservation& found, bool is_same);
  void refuse(RejectReason reason, const std::string& detail) {
    has_own_trace = true;
    traceRefused(detector.trace(), reason, detail, own_trace);
  }
  std::optional<WindowObservation> complete(const TrackInput& input);
  std::optional<WindowObservation> askSearch(const TrackInput& input);
  bool surrounds(const TrackInput& input);
  void learnBorders() {
    borders = std::make_unique<ReferenceBorders>(params.borders);
    if (reference) borders->learn(reference->picture(), reference->opening());
  }
  void forget() {
    identity.forget();
    has_motion = tracking = false;
    last_sec.reset();
    last_attitude.reset();
  }

  DetectorParams params;
  WindowDetector detector;
  BorderRefinement refinement;
  std::shared_ptr<ReferenceAppearance> reference;  // shared with the detector
  QuadMotion motion;
  BorderQuartet quartet;
  TargetIdentity identity;
  SecondOpinion opinion;
  std::unique_ptr<ReferenceBorders> borders;
  WindowObservation window;  // as followed last
  DetectionTrace own_trace;  // where the search's does not tell what happened
  std::optional<geometry::PinholeCamera> camera;
  const geometry::PinholeCamera* lens = nullptr;  // of this frame, if it distorts
  cv::Size size;
  std::optional<double> last_sec;
  std::optional<Eigen::Matrix3d> last_attitude;
  double elapsed_sec = 0.0, certainty = 0.0;
  int frames_to_comparison = 0, frames_to_completion = 0;
  bool tracking = false, has_motion = false, place_given = false, has_own_trace = false, unlike = false;
};

bool WindowTracker::Impl::isContinued(const TrackInput& input) const {
  if (!last_sec || input.image.size() != size || (input.camera != nullptr) != camera.has_value())
    return false;
  if (input.camera && !isSameCalibration(*input.camera, *camera)) return false;
  const double elapsed = input.stamp_sec - *last_sec;
  return elapsed > 0.0 && elapsed <= params.track.max_gap_sec;
}

// Time, calibration and what they say about the track so far.
void WindowTracker::Impl::begin(const TrackInput& input) {
  if (!isContinued(input)) forget();
  elapsed_sec = last_sec ? input.stamp_sec - *last_sec : 0.0;
  size = input.image.size();
  camera.reset();
  if (input.camera) camera = *input.camera;
  lens = camera && camera->hasDistortion() ? &*camera : nullptr;
  if (has_motion) predict(input);
  last_sec = input.stamp_sec;
  last_attitude = input.R_world_camera;
}

Eigen::Matrix3d WindowTracker::Impl::turn(const TrackInput& input) const {
  const Eigen::Matrix3d K = input.camera->K();
  const Eigen::Matrix3d R_now_last = input.R_world_camera->transpose() * *last_attitude;
  return K * R_now_last * K.inverse();
}

QuadSpread WindowTracker::Impl::spread(const TrackInput& input, bool has_attitude) const {
  const double longer = std::max(input.image.cols, input.image.rows), side = sizeOf(motion.quad());
  const double place = has_attitude ? params.track.turn_known : params.track.turn;
  return {place * longer * elapsed_sec, params.track.reshape * side * elapsed_sec,
          params.track.warp * side * elapsed_sec};
}

void WindowTracker::Impl::predict(const TrackInput& input) {
  const bool has_attitude =
      input.camera && input.R_world_camera && last_attitude && input.R_world_camera->allFinite();
  motion.predict(has_attitude ? turn(input) : Eigen::Matrix3d(Eigen::Matrix3d::Identity()), elapsed_sec,
                 spread(input, has_attitude));
  place_given =
      input.predicted && geometry::isFinite(*input.predicted) && geometry::isConvex(*input.predicted);
  if (!place_given) return;
  const double sigma_px = params.track.given_sigma * std::max(size.width, size.height);
  motion.foretell(undistorted(*input.predicted, lens), {sigma_px, sigma_px, kGivenWarp * sigma_px});
}

bool WindowTracker::Impl::follow(const TrackInput& input) {
  const bool found = quartet.follow(input.image, lens, motion);
  const double quality = found ? quartet.quality() * (unlike ? kUnlikePart : 1.0) : 0.0;
  certainty += kQualityRate * (quality - certainty);
  if (!found || certainty < params.track.min_certainty) return false;
  motion.settle(elapsed_sec);
  quartet.keep(input.image, lens, motion.quad());
  quartet.describe(input.image, lens, motion, window);
  identity.follow(input.stamp_sec);
  window.stamp_sec = input.stamp_sec;
  window.target_id = identity.id();
  compareRing(input);
  window.score = std::clamp(certainty, 0.0, 1.0);
  return true;
}

// The reference's borders, looked for about the track, are elsewhere.
bool WindowTracker::Impl::strays(const TrackInput& input) {
  const Quadrilateral followed = distorted(motion.quad(), lens);
  const auto found = borders->locate(input.image, followed, input.camera, ReferenceBorders::kFine);
  if (!found || found->worth < kSureWorth) return false;
  return furthestCorner(found->quad, followed) > std::max(kLeastStrayPx, kStray * sizeOf(followed));
}

// From time to time: does it still look like the reference? While it surely does, the reference follows the
// light.
void WindowTracker::Impl::compareRing(const TrackInput& input) {
  if (!reference || quartet.inView() < 4 || --frames_to_comparison > 0) return;
  frames_to_comparison = params.track.appearance_every;
  if (strays(input)) opinion.doubt();
  if (!window.whole()) return;
  const auto match = reference->compare(input.image, window.corners, params.appearance);
  window.has_appearance = match.has_value();
  window.bhattacharyya = match ? match->distance : 0.0;
  unlike = match && match->distance > match->limit;
  if (unlike) opinion.doubt();
  if (match && !unlike && opinion.isConfirmed() && certainty > params.track.adapt_certainty &&
      quartet.fitted() == 4)
    reference->adapt(input.image, window.corners, params.track.adaptation, params.appearance);
}

// The search's window becomes the one that is own_trace.
void WindowTracker::Impl::take(const TrackInput& input, WindowObservation& found, bool is_same) {
  const Quadrilateral quad = undistorted(found.corners, lens);
  identity.found(is_same, input.stamp_sec);
  if (is_same)
    opinion.restart();
  else
    opinion.start();
  found.target_id = identity.id();
  motion.start(quad, kFoundSigmaPx);
  quartet.learn(input.image, lens, quad);
  certainty = std::max(found.score, 2.0 * params.track.min_certainty);
  if (!is_same) frames_to_comparison = params.track.appearance_every;
  unlike = false;
  window = found;
  tracking = has_motion = true;
}

// A window that the search passed over for a better one, where the old one must be.
std::optional<WindowObservation> WindowTracker::Impl::amongOthers(const TrackInput& input) {
  for (const CandidateTrace& other : detector.trace().candidates) {
    if (other.reject != RejectReason::kOutscored ||
        !identity.isSame(undistorted(other.quad, lens), motion.quad()))
      continue;
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
  bool is_same = remembers && identity.isSame(undistorted(found->corners, lens), motion.quad());
  if (remembers && !is_same) {
    if (auto other = amongOthers(input)) found = other, is_same = true;
  }
  if (remembers && !is_same && identity.settled()) {
    refuse(RejectReason::kOutscored, "another window is in view; the one that was followed is waited for");
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
  const Quadrilateral seen = undistorted(found->corners, lens), expected = motion.quad();
  const double limit_px = 2.0 * params.track.reach * std::max(size.width, size.height);
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
  if (found) searched = undistorted(found->corners, lens);
  if (!opinion.prefers(searched, motion.quad())) return std::nullopt;
  has_own_trace = false;
  take(input, *found, identity.isSame(*searched, motion.quad()));
  return found;
}

// So near that no two sides are in view: the window is where it must be, for a while.
bool WindowTracker::Impl::surrounds(const TrackInput& input) {
  if (quartet.inView() >= 2 || !identity.settled() || !identity.remembers(input.stamp_sec, place_given) ||
      !geometry::contains(motion.quad(), {0.5 * size.width, 0.5 * size.height}))
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
  impl_->learnBorders();
  impl_->forget();
}

void WindowTracker::setReference(const ReferenceAppearance& reference) {
  impl_->reference = std::make_shared<ReferenceAppearance>(reference);
  impl_->detector.shareReference(impl_->reference);
  impl_->learnBorders();
  impl_->forget();
}

void WindowTracker::clearReference() {
  impl_->reference.reset();
  impl_->borders.reset();
  impl_->detector.clearReference();
  impl_->forget();
}

void WindowTracker::reset() { impl_->forget(); }

std::optional<WindowObservation> WindowTracker::update(const TrackInput& input) {
  if (!isPicture(input.image) || !std::isfinite(input.stamp_sec)) {
    impl_->forget();
    impl_->has_own_trace = false;
    return impl_->detector.detect(input.image, input.stamp_sec, input.camera);
  }
  impl_->begin(input);
  if (impl_->tracking && impl_->follow(input)) {
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

double WindowTracker::referenceDrift() const { return impl_->reference ? impl_->reference->drift() : 0.0; }

bool WindowTracker::tracking() const { return impl_->tracking; }

}  // namespace window_ingress::detection
