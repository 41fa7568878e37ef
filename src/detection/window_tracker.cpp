#include "window_ingress/detection/window_tracker.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "window_ingress/detection/border_quartet.hpp"
#include "window_ingress/detection/target_identity.hpp"
#include "window_ingress/detection/track_trace.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::detection {
namespace {

using geometry::Quadrilateral;

constexpr double kFoundSigmaPx = 0.3;     // of corners just found
constexpr double kQualityRate = 0.25;     // part of the certainty that a frame replaces
constexpr double kUnlikePart = 0.7;       // of the quality while the ring does not look like the reference
constexpr double kGivenWarp = 0.3;        // spread of the shape of a given prediction, of that of its place
constexpr int kCompletionFrames = 10;     // between searches for a border that is in view and not found
constexpr double kVariantRadiusPx = 4.0;  // reach of the fit of a candidate that the search passed over

bool isImage(const cv::Mat& image) {
  return !image.empty() && (image.type() == CV_8UC1 || image.type() == CV_8UC3);
}

bool sameCamera(const geometry::PinholeCamera& a, const geometry::PinholeCamera& b) {
  return a.width == b.width && a.height == b.height && a.fx == b.fx && a.fy == b.fy && a.cx == b.cx &&
         a.cy == b.cy && a.distortion == b.distortion;
}

double sizeOf(const Quadrilateral& quad) { return std::sqrt(std::abs(geometry::signedArea(quad))); }

Quadrilateral undistorted(Quadrilateral quad, const geometry::PinholeCamera* lens) {
  if (lens)
    for (auto& corner : quad) corner = lens->undistort(corner);
  return quad;
}

}  // namespace

struct WindowTracker::Impl {
  explicit Impl(const DetectorParams& p)
      : params(p),
        detector(p),
        refinement(p.refinement),
        motion(),
        quartet(p.track, p.refinement),
        identity(p.track) {}

  bool isContinued(const TrackInput& input) const;
  void begin(const TrackInput& input);
  void predict(const TrackInput& input);
  Eigen::Matrix3d turn(const TrackInput& input) const;
  QuadSpread spread(const TrackInput& input, bool has_attitude) const;
  bool follow(const TrackInput& input);
  void compareRing(const TrackInput& input);
  std::optional<WindowObservation> search(const TrackInput& input);
  std::optional<WindowObservation> amongOthers(const TrackInput& input);
  void take(const TrackInput& input, WindowObservation& found, bool is_same);
  void refuse(RejectReason reason, const std::string& detail) {
    has_own_trace = true;
    traceRefused(detector.trace(), reason, detail, own_trace);
  }
  std::optional<WindowObservation> complete(const TrackInput& input);
  bool surrounds(const TrackInput& input);
  void forget() {
    identity.forget();
    has_motion = tracking = false;
    last_sec.reset();
    last_attitude.reset();
  }

  DetectorParams params;
  WindowDetector detector;
  BorderRefinement refinement;
  std::optional<ReferenceAppearance> reference;
  QuadMotion motion;
  BorderQuartet quartet;
  TargetIdentity identity;
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
  if (input.camera && !sameCamera(*input.camera, *camera)) return false;
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

// From time to time: does it still look like the reference?
void WindowTracker::Impl::compareRing(const TrackInput& input) {
  if (!reference || !window.whole() || --frames_to_comparison > 0) return;
  frames_to_comparison = params.track.appearance_every;
  const auto distance = reference->distance(input.image, window.corners, params.appearance);
  window.has_appearance = distance.has_value();
  window.bhattacharyya = distance.value_or(0.0);
  unlike = distance && *distance > params.appearance.max_distance;
}

// The search's window becomes the one that is own_trace.
void WindowTracker::Impl::take(const TrackInput& input, WindowObservation& found, bool is_same) {
  const Quadrilateral quad = undistorted(found.corners, lens);
  identity.found(is_same, input.stamp_sec);
  found.target_id = identity.id();
  motion.start(quad, kFoundSigmaPx);
  quartet.learn(input.image, lens, quad);
  certainty = std::max(found.score, 2.0 * params.track.min_certainty);
  frames_to_comparison = params.track.appearance_every;
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
    WindowObservation found;
    found.stamp_sec = input.stamp_sec;
    found.corners = borders->corners;
    found.corner_covariance = borders->corner_covariance;
    found.edges = borders->edges;
    found.score = other.score;
    found.has_appearance = other.has_appearance;
    found.bhattacharyya = other.bhattacharyya;
    return found;
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
  for (int i = 0; i < 4; ++i)
    if (!((seen[i] - expected[i]).norm() < limit_px)) return std::nullopt;
  has_own_trace = false;
  take(input, *found, true);
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
  impl_->forget();
}

void WindowTracker::setReference(const ReferenceAppearance& reference) {
  impl_->reference = reference;
  impl_->detector.setReference(reference);
  impl_->forget();
}

void WindowTracker::clearReference() {
  impl_->reference.reset();
  impl_->detector.clearReference();
  impl_->forget();
}

void WindowTracker::reset() { impl_->forget(); }

std::optional<WindowObservation> WindowTracker::update(const TrackInput& input) {
  if (!isImage(input.image) || !std::isfinite(input.stamp_sec)) {
    impl_->forget();
    impl_->has_own_trace = false;
    return impl_->detector.detect(input.image, input.stamp_sec, input.camera);
  }
  impl_->begin(input);
  if (impl_->tracking && impl_->follow(input)) {
    impl_->has_own_trace = true;
    traceFollowed(impl_->window, impl_->own_trace);
    auto whole = impl_->complete(input);
    return whole ? whole : impl_->window;
  }
  if (impl_->tracking && impl_->surrounds(input)) return std::nullopt;
  impl_->tracking = false;
  return impl_->search(input);
}

const DetectionTrace& WindowTracker::trace() const {
  return impl_->has_own_trace ? impl_->own_trace : impl_->detector.trace();
}

bool WindowTracker::tracking() const { return impl_->tracking; }

}  // namespace window_ingress::detection
