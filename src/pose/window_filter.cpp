#include "window_ingress/pose/window_filter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/pose/observation_check.hpp"
#include "window_ingress/pose/viewpoints.hpp"
#include "window_ingress/pose/window_beliefs.hpp"

namespace window_ingress::pose {
namespace {

constexpr double kExpectedSquares = 8.0;
constexpr double kMeanOver = 30.0;  // images

}  // namespace

struct WindowFilter::Impl {
  explicit Impl(const FilterParams& p) : params(p), viewpoints(p.systematic_renewal_m), beliefs(p) {}

  FilterParams params;
  Viewpoints viewpoints;
  WindowBeliefs beliefs;
  double stamp_sec = 0.0;
  double interval_sec = 1.0;
  Eigen::Vector3d camera_position = Eigen::Vector3d::Zero();
  geometry::OpeningSize opening;
  int updates = 0;
  int outliers = 0;
  double mean_squares = kExpectedSquares;

  void forgetImages() {
    viewpoints.clear();
    updates = outliers = 0;
    mean_squares = kExpectedSquares;
  }

  void reset() {
    beliefs.clear();
    forgetImages();
  }

  ImageNoise noise() const { return {params.systematic_sigma_px, params.unknown_corner_sigma_px, 1.0, 1.0}; }

  ImageNoise noiseAt(const Eigen::Vector3d& position) const {
    ImageNoise shared = noise();
    shared.looks = viewpoints.looksWith(position);
    shared.max_looks_variance = std::max(1.0, params.systematic_renewal_sec / interval_sec);
    return shared;
  }

  void accept(double stamp, const FilterView& view) {
    stamp_sec = stamp;
    camera_position = view.T_odom_camera.translation();
    viewpoints.add(camera_position);
    outliers = 0;
    ++updates;
  }

  // What was believed before is kept until a new start succeeds.
  bool start(const WindowPoseEstimate* estimate, double stamp, const FilterView& alone) {
    if (!estimate || !beliefs.start(alone.T_odom_camera * estimate->best.T_camera_window, alone))
      return false;
    forgetImages();
    opening = estimate->opening;
    accept(stamp, alone);
    return true;
  }

  bool isInOrder(double stamp) {
    if (!std::isfinite(stamp)) return false;
    if (beliefs.empty()) return true;
    const double elapsed = stamp - stamp_sec;
    if (elapsed < -params.time_jump_sec || elapsed > params.max_age_sec) {
      reset();
      return true;
    }
    if (elapsed > 0.0) interval_sec = std::clamp(elapsed, 0.005, 1.0);
    return elapsed > 0.0;
  }

  bool update(const WindowPoseEstimate* estimate, const detection::WindowObservation& window,
              const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera) {
    if (!geometry::isValidPose(T_odom_camera) || !camera.validate().empty() || !isInOrder(window.stamp_sec) ||
        (window.whole() && (!geometry::isFinite(window.corners) || !geometry::isConvex(window.corners))))
      return false;
    const Eigen::Vector3d up_camera = T_odom_camera.linear().transpose().col(2);
    if (!isUpright(window, up_camera)) return false;
    const auto ordered = upright(window, up_camera);
    const auto shared = ImageMeasurement::make(ordered, camera, noiseAt(T_odom_camera.translation()));
    const auto first = ImageMeasurement::make(ordered, camera, noise());
    if (!shared || !first) return false;
    const auto size = estimate ? estimate->opening : opening;
    const FilterView view{*shared, camera, size, T_odom_camera};
    const FilterView alone{*first, camera, size, T_odom_camera};
    return apply(estimate, window.stamp_sec, view, alone);
  }

  bool apply(const WindowPoseEstimate* estimate, double stamp, const FilterView& view,
             const FilterView& alone) {
    if (beliefs.empty()) return start(estimate, stamp, alone);
    if (mean_squares > params.max_mean_squares && start(estimate, stamp, alone)) return true;
    const auto squares = beliefs.apply(view, alone, stamp - stamp_sec, camera_position);
    if (!squares) return ++outliers >= params.outliers_until_restart && start(estimate, stamp, alone);
    mean_squares += (*squares - mean_squares) / kMeanOver;
    accept(stamp, view);
    return true;
  }
};

WindowFilter::WindowFilter(const FilterParams& params) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("filter parameters: " + parameters::joined(faults));
  impl_ = std::make_unique<Impl>(params);
}

WindowFilter::~WindowFilter() = default;

bool WindowFilter::update(const WindowPoseEstimate& estimate, const detection::WindowObservation& window,
                          const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera) {
  return impl_->update(&estimate, window, camera, T_odom_camera);
}

bool WindowFilter::update(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                          const Eigen::Isometry3d& T_odom_camera) {
  return impl_->update(nullptr, window, camera, T_odom_camera);
}

std::optional<FilteredWindow> WindowFilter::state(double now_sec) const {
  const Impl& self = *impl_;
  if (self.beliefs.empty() || !std::isfinite(now_sec)) return std::nullopt;
  const double age = now_sec - self.stamp_sec;
  if (age > self.params.max_age_sec || age < -self.params.time_jump_sec) return std::nullopt;
  const auto& [believed, log_weight] = self.beliefs.hypotheses().front();
  WindowHypothesis window = believed;
  window.predict(self.params, std::max(age, 0.0), self.camera_position, self.camera_position);

  FilteredWindow out;
  out.stamp_sec = self.stamp_sec;
  out.T_odom_window = window.T_odom_window();
  out.covariance.topLeftCorner<3, 3>() = window.covariance().topLeftCorner<3, 3>();
  out.covariance.topRightCorner<3, 1>() = window.covariance().block<3, 1>(0, WindowHypothesis::kYaw);
  out.covariance.bottomLeftCorner<1, 3>() = out.covariance.topRightCorner<3, 1>().transpose();
  out.covariance(3, 3) = out.covariance(4, 4) = std::pow(self.params.attitude_bias_sigma_rad, 2);
  out.covariance(5, 5) = window.covariance()(WindowHypothesis::kYaw, WindowHypothesis::kYaw);
  out.hypothesis_weight = std::exp(log_weight);
  out.updates = self.updates;
  out.sign_trusted = self.beliefs.areUnambiguous() && window.yawSigma() < self.params.trusted_yaw_sigma_rad;
  return out;
}

std::optional<geometry::Quadrilateral> WindowFilter::predictedCorners(
    double now_sec, const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera) const {
  if (!state(now_sec) || !geometry::isValidPose(T_odom_camera)) return std::nullopt;
  return geometry::projectOpening(
      camera, impl_->beliefs.hypotheses().front().window.T_camera_window(T_odom_camera), impl_->opening);
}

void WindowFilter::reset() { impl_->reset(); }

}  // namespace window_ingress::pose
