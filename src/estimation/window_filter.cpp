#include "window_ingress/estimation/window_filter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "estimation/filter/mirror_hypotheses.hpp"
#include "estimation/filter/odometry_smoother.hpp"
#include "estimation/filter/viewpoints.hpp"
#include "estimation/planar/observation_check.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kExpectedSquares = 8.0;
constexpr double kMeanOver = 30.0;              // images in the running mean
constexpr double kRestartMeanSquares = 20.0;    // running mean above which the filter restarts
constexpr double kTurnedRad = 0.15;             // turn of the window between two starts: odometry has turned
constexpr double kFixedYawSigmaRad = 0.005;     // of the yaw bias after odometry turned or jumped
constexpr double kTurningSec = 3.0;             // odometry turns for at most this many seconds
constexpr double kMinScaleMps = 0.1;            // below this speed the path says nothing about the size
constexpr double kRareSec = 0.25;               // interval of images that are too rare for a path
constexpr double kSystematicRenewalSec = 20.0;  // renewal of the systematic error at one place
constexpr double kTimeJumpSec = 1.0;            // an image older by this much is a jump back in time
constexpr double kMaxHeldSigma = 0.1;           // a less certain size is not kept over a restart
constexpr double kSureOfHeight = 0.2;           // relative standard deviation
constexpr double kHeldSigmaGrowth = 1.5;        // of a kept size, because the restart may have had a reason

}  // namespace

struct WindowFilter::Impl {
  Impl(const FilterParams& p, const std::optional<SizeEstimate>& size) : params(p), nominal_size(size) {}

  FilterParams params;
  std::optional<SizeEstimate> nominal_size, held_size;
  YawBias yaw_bias{0.0, params.mounting_yaw_sigma_rad};  // initially
  double unlearned_yaw_rad = 0.0;                        // standard deviation, since odometry turned
  double turned_sec = 0.0;
  Viewpoints viewpoints;
  MirrorHypotheses beliefs{params};
  ConsistencyMonitor consistency;
  OdometrySmoother path;
  std::uint32_t target_id = 0;
  double stamp_sec = 0.0, interval_sec = 1.0;
  Eigen::Vector3d camera_position = Eigen::Vector3d::Zero();
  int updates = 0, outliers = 0;
  double mean_squares = kExpectedSquares;

  bool sizeIsKnown() const { return !nominal_size || nominal_size->log_covariance.isZero(0.0); }
  const WindowHypothesis& believed() const { return beliefs.hypotheses().front().window; }

  void forgetImages() {
    viewpoints.clear();
    consistency.clear();
    updates = outliers = 0;
    mean_squares = kExpectedSquares;
  }

  void forgetPlaces() {
    hold();
    path.clear();
    beliefs.clear();
    forgetImages();
  }

  void reset() {
    forgetPlaces();
    held_size.reset();
    yaw_bias = {0.0, params.mounting_yaw_sigma_rad};
    unlearned_yaw_rad = 0.0;
  }

  // A filter that contradicted its images has nothing worth keeping.
  void hold() {
    if (beliefs.empty()) return;
    held_size.reset();
    if (!beliefs.areUnambiguous() || mean_squares > kRestartMeanSquares) return;
    if (params.yaw_bias_lasts) yaw_bias = believed().yawBias();
    SizeEstimate found = believed().size();
    if (sizeIsKnown() || found.log_covariance.trace() > kMaxHeldSigma * kMaxHeldSigma) return;
    found.log_covariance *= kHeldSigmaGrowth * kHeldSigmaGrowth;
    held_size = found;
  }

  // A recent turn of odometry must not be learned as a lasting yaw bias. Until the turn is over, the earlier
  // uncertainty of the bias is not learned, but still counts.
  void fixYawBias() {
    if (!params.yaw_bias_lasts) return;
    turned_sec = stamp_sec;
    if (yaw_bias.sigma_rad <= kFixedYawSigmaRad) return;
    unlearned_yaw_rad = std::hypot(unlearned_yaw_rad, yaw_bias.sigma_rad);
    yaw_bias.sigma_rad = kFixedYawSigmaRad;
  }

  void learnYawAgain(double stamp) {
    if (unlearned_yaw_rad == 0.0 || std::abs(stamp - turned_sec) < kTurningSec) return;
    beliefs.learnYaw(unlearned_yaw_rad, camera_position);
    unlearned_yaw_rad = 0.0;
  }

  SizeEstimate priorSize(const geometry::OpeningSize& fitted) const {
    if (held_size) return *held_size;
    return {fitted, nominal_size ? nominal_size->log_covariance : Eigen::Matrix2d::Zero()};
  }

  // While the scale is uncertain, its estimate is replaced by the nominal height.
  SizeEstimate believedSize() const {
    SizeEstimate size = believed().size();
    if (size.log_covariance(1, 1) < kSureOfHeight * kSureOfHeight) return size;
    const double height_m = nominal_size->size.height_m;
    size.size = {size.size.width_m * height_m / size.size.height_m, height_m};
    return size;
  }

  std::optional<SizeEstimate> sizeOf(const detection::WindowObservation& window) const {
    const bool is_same = target_id == 0 || window.target_id == 0 || window.target_id == target_id;
    if (sizeIsKnown() || !is_same) return nominal_size;
    if (!beliefs.empty()) return believedSize();
    return held_size ? held_size : nominal_size;
  }

  ImageNoise noise() const { return {params.systematic_sigma_px, 1.0, 1.0}; }

  ImageNoise noiseAt(const Eigen::Vector3d& position) const {
    ImageNoise shared = noise();
    shared.looks = viewpoints.looksWith(position);
    shared.max_looks_variance = std::max(1.0, kSystematicRenewalSec / interval_sec);
    return shared;
  }

  void accept(double stamp, const FilterView& view) {
    stamp_sec = stamp;
    camera_position = view.T_odom_camera.translation();
    viewpoints.add(camera_position);
    outliers = 0;
    ++updates;
  }

  // Keeps the previous beliefs until a new start succeeds.
  bool start(const std::optional<WindowPoseEstimate>& estimate, double stamp, const FilterView& view) {
    if (!estimate) return false;
    const FilterView alone{view.alone, view.alone, view.camera, view.T_odom_camera, {}, true, view.motion};
    const Eigen::Isometry3d T_odom_window = alone.T_odom_camera * estimate->best.T_camera_window;
    hold();
    const double yaw_rad = geometry::yawOf(T_odom_window.linear());
    if (!beliefs.empty() && std::abs(geometry::wrapAngle(yaw_rad - believed().state().yaw())) > kTurnedRad)
      fixYawBias();
    if (!beliefs.start(T_odom_window, priorSize(estimate->opening), yaw_bias, alone)) return false;
    forgetImages();
    accept(stamp, alone);
    return true;
  }

  bool isInOrder(double stamp) {
    if (!std::isfinite(stamp)) return false;
    if (beliefs.empty()) return true;
    const double elapsed = stamp - stamp_sec;
    if (elapsed < -kTimeJumpSec) reset();
    if (elapsed > params.max_age_sec) forgetPlaces();
    if (beliefs.empty()) return true;
    if (elapsed > 0.0) interval_sec = std::clamp(elapsed, 0.005, 1.0);
    return elapsed > 0.0;
  }

  void startAnewForAnotherTarget(std::uint32_t seen_id) {
    if (seen_id == 0) return;
    if (target_id != 0 && seen_id != target_id) reset();
    target_id = seen_id;
  }

  bool update(const std::optional<WindowPoseEstimate>& estimate, const detection::WindowObservation& window,
              const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera,
              const CameraMotion& camera_motion) {
    if (!geometry::isValidPose(T_odom_camera) || !camera.validate().empty() || !isInOrder(window.stamp_sec) ||
        (window.whole() && (!geometry::isFinite(window.corners) || !geometry::isConvex(window.corners))))
      return false;
    const Eigen::Vector3d up_camera = T_odom_camera.linear().transpose().col(2);
    if (!isUpright(window, up_camera)) return false;
    const auto ordered = upright(window, up_camera);
    const auto shared = ImageMeasurement::make(ordered, camera, noiseAt(T_odom_camera.translation()));
    const auto first = ImageMeasurement::make(ordered, camera, noise());
    if (!shared || !first) return false;
    startAnewForAnotherTarget(window.target_id);
    path.add(window.stamp_sec, T_odom_camera.translation());
    const auto motion = path.motion();
    const Eigen::Vector3d jitter =
        motion ? Eigen::Vector3d(T_odom_camera.translation() - motion->position_m) : Eigen::Vector3d::Zero();
    const bool moves = moved(motion, window.stamp_sec, T_odom_camera.translation());
    return apply(estimate, window.stamp_sec,
                 {*shared, *first, camera, T_odom_camera, jitter, moves, camera_motion});
  }

  // Images too rare for a path are so far apart that jitter does not pass for motion.
  bool moved(const std::optional<OdometrySmoother::Motion>& motion, double stamp,
             const Eigen::Vector3d& position_m) const {
    if (motion) return motion->velocity_mps.norm() >= kMinScaleMps;
    const double elapsed_sec = stamp - stamp_sec;
    return elapsed_sec >= kRareSec && (position_m - camera_position).norm() >= kMinScaleMps * elapsed_sec;
  }

  // Jitter is no distance flown. But where distance determines the scale, jitter counts as drift: otherwise
  // the jitter left in the smoothed path would make the scale too certain.
  double wayTo(const FilterView& view, double stamp) const {
    const double moved_m = (view.T_odom_camera.translation() - camera_position).norm();
    const auto motion = path.motion();
    return motion && sizeIsKnown() ? std::min(moved_m, motion->velocity_mps.norm() * (stamp - stamp_sec))
                                   : moved_m;
  }

  bool apply(const std::optional<WindowPoseEstimate>& estimate, double stamp, const FilterView& view) {
    if (beliefs.empty()) return start(estimate, stamp, view);
    if (mean_squares > kRestartMeanSquares && start(estimate, stamp, view)) return true;
    learnYawAgain(stamp);
    const auto outcome = beliefs.apply(view, stamp - stamp_sec, wayTo(view, stamp));
    if (!outcome) {
      consistency.refuse();
      return ++outliers >= params.outliers_until_restart && start(estimate, stamp, view);
    }
    mean_squares += (outcome->squares - mean_squares) / kMeanOver;
    consistency.add(outcome->squares, view.alone.size());
    accept(stamp, view);
    return true;
  }
};

WindowFilter::WindowFilter(const FilterParams& params, const std::optional<SizeEstimate>& size) {
  parameters::requireInRange(params, "filter parameters");
  if (size && !isUsable(*size)) throw std::invalid_argument("filter: the size of the opening is not usable");
  impl_ = std::make_unique<Impl>(params, size);
}

WindowFilter::~WindowFilter() = default;
WindowFilter::WindowFilter(WindowFilter&&) noexcept = default;
WindowFilter& WindowFilter::operator=(WindowFilter&&) noexcept = default;

bool WindowFilter::update(const std::optional<WindowPoseEstimate>& estimate,
                          const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                          const Eigen::Isometry3d& T_odom_camera, const CameraMotion& motion) {
  return impl_->update(estimate, window, camera, T_odom_camera, motion);
}

std::optional<SizeEstimate> WindowFilter::sizeOf(const detection::WindowObservation& window) const {
  return impl_->sizeOf(window);
}

std::optional<FilteredWindow> WindowFilter::state(double now_sec) const {
  const Impl& self = *impl_;
  if (self.beliefs.empty() || !std::isfinite(now_sec)) return std::nullopt;
  const double age_sec = now_sec - self.stamp_sec;
  if (age_sec > self.params.max_age_sec || age_sec < -kTimeJumpSec) return std::nullopt;
  FilteredWindow out = self.beliefs.windowAt(age_sec, self.camera_position, self.unlearned_yaw_rad);
  out.stamp_sec = self.stamp_sec;
  out.updates = self.updates;
  out.consistency = self.consistency.consistency();
  return out;
}

void WindowFilter::reset() { impl_->reset(); }

void WindowFilter::assumeDrift(double m_per_sqrt_sec) {
  impl_->beliefs.assumeDrift(std::max(m_per_sqrt_sec, impl_->params.drift_m_per_sqrt_sec));
}

void WindowFilter::forgetPlaces() {
  impl_->forgetPlaces();
  impl_->fixYawBias();
}

}  // namespace window_ingress::estimation
