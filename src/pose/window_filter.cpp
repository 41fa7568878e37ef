#include "window_ingress/pose/window_filter.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/pose/observation_check.hpp"
#include "window_ingress/pose/viewpoints.hpp"
#include "window_ingress/pose/window_hypothesis.hpp"

namespace window_ingress::pose {
namespace {

constexpr double kMergeDistance = 0.5;  // squared Mahalanobis
constexpr double kExpectedSquares = 8.0;
constexpr double kMeanOver = 30.0;    // images
constexpr double kSplitSigmas = 1.0;  // from here on a mirror image is a mode of its own

double upperTail(double sigmas) { return 0.5 * std::erfc(sigmas / std::sqrt(2.0)); }

struct Weighted {
  WindowHypothesis window;
  double log_weight;
};

}  // namespace

struct WindowFilter::Impl {
  FilterParams params;
  Viewpoints viewpoints{params.systematic_renewal_m};
  std::vector<Weighted> hypotheses{};  // heaviest first
  bool may_split = false;              // no evidence has killed the mirror image yet
  double stamp_sec = 0.0;
  double interval_sec = 1.0;
  Eigen::Vector3d camera_position = Eigen::Vector3d::Zero();
  geometry::OpeningSize opening{};
  int updates = 0;
  int outliers = 0;
  double mean_squares = kExpectedSquares;

  void reset() {
    hypotheses.clear();
    viewpoints.clear();
    updates = outliers = 0;
    mean_squares = kExpectedSquares;
    may_split = false;
  }

  ImageNoise noise() const { return {params.systematic_sigma_px, params.unknown_corner_sigma_px, 1.0, 1.0}; }

  ImageNoise noiseAt(const Eigen::Vector3d& position) const {
    ImageNoise shared = noise();
    shared.looks = viewpoints.looksWith(position);
    shared.max_looks_variance = std::max(1.0, params.systematic_renewal_sec / interval_sec);
    return shared;
  }

  // The alternative of a free fit may be missing where that of an upright window is not: it is sought anew.
  bool start(const WindowPoseEstimate& estimate, const FilterView& view) {
    reset();
    WindowHypothesis window(params, view.T_odom_camera * estimate.best.T_camera_window);
    const auto outcome = window.update(params, view);
    if (!outcome || outcome->squares > params.gate_squares) return false;
    hypotheses.push_back({window, 0.0});
    opening = estimate.opening;
    may_split = true;
    addMirrorImage(view, outcome->squares);
    accept(estimate.stamp_sec, view);
    return true;
  }

  // Where noise has levelled the mirror image's own minimum, its mass is still there: it is then held by the
  // spread of the first belief. Weighted by how much worse it explains the image.
  void addMirrorImage(const FilterView& view, double squares) {
    const WindowHypothesis& window = hypotheses[0].window;
    const Eigen::Vector3d position = view.T_odom_camera.translation();
    const Eigen::Isometry3d image = window.mirrored(position).T_odom_window();
    WindowHypothesis other(params, image);
    auto outcome = other.update(params, view);
    if (!outcome || window.distanceTo(other) < kMergeDistance) {
      if (std::abs(window.yawFromSight(position)) < kSplitSigmas * window.yawSigma()) return;
      other = WindowHypothesis(params, image, window.yawSigma());
      outcome = other.update(params, view);
    }
    if (outcome)
      hypotheses.push_back(
          {other, std::clamp(0.5 * (squares - outcome->squares), -params.max_evidence, 0.7)});
  }

  // All hypotheses over one image; false if none of them can explain it.
  // Whether an image is an outlier must not depend on how many were taken from its place: `alone` has it as
  // the first.
  bool apply(const FilterView& view, const FilterView& alone, double stamp) {
    std::vector<Weighted> tried = hypotheses;
    std::vector<double> evidence;
    double best = -1e300, least_squares = params.gate_squares;
    bool explained = false;
    for (std::size_t i = 0; i < tried.size(); ++i) {
      WindowHypothesis& window = tried[i].window;
      window.predict(params, stamp - stamp_sec, camera_position, view.T_odom_camera.translation());
      WindowHypothesis updated = window, updated_alone = window;
      const auto outcome = updated.update(params, view);
      const auto outcome_alone = updated_alone.update(params, alone);
      const bool inside = outcome && outcome_alone && outcome_alone->squares <= params.gate_squares;
      evidence.push_back(inside ? outcome->log_evidence : -1e300);
      if (inside) window = updated;
      if (inside) least_squares = std::min(least_squares, outcome_alone->squares);
      explained = explained || inside;
      best = std::max(best, evidence.back());
    }
    if (!explained) return false;
    for (std::size_t i = 0; i < tried.size(); ++i)
      tried[i].log_weight += std::max(evidence[i] - best, -params.max_evidence);
    hypotheses = tried;
    mean_squares += (least_squares - mean_squares) / kMeanOver;
    return true;
  }

  void normalise() {
    std::sort(hypotheses.begin(), hypotheses.end(),
              [](auto& a, auto& b) { return a.log_weight > b.log_weight; });
    double sum = 0.0;
    for (const auto& h : hypotheses) sum += std::exp(h.log_weight - hypotheses.front().log_weight);
    const double log_sum = hypotheses.front().log_weight + std::log(sum);
    for (auto& h : hypotheses) h.log_weight -= log_sum;
  }

  void prune() {
    if (hypotheses.size() == 2 && hypotheses[0].window.distanceTo(hypotheses[1].window) < kMergeDistance) {
      const double share = std::exp(hypotheses[1].log_weight);
      hypotheses[0].window = hypotheses[0].window.mergedWith(hypotheses[1].window, share);
      hypotheses.pop_back();
      may_split = true;
    } else if (hypotheses.size() == 2 && std::exp(hypotheses[1].log_weight) < params.dead_weight) {
      hypotheses.pop_back();
      may_split = false;
    }
  }

  // A single belief that lies between both mirror images holds some of the other one's mass: it becomes two.
  void split() {
    if (hypotheses.size() != 1 || !may_split) return;
    const WindowHypothesis& window = hypotheses[0].window;
    const double angle = std::abs(window.yawFromSight(camera_position)), sigmas = angle / window.yawSigma();
    if (2.0 * angle < params.harmless_yaw_rad || sigmas < kSplitSigmas) return;
    const double other = upperTail(sigmas);
    if (other < params.dead_weight) return;
    hypotheses.push_back({window.mirrored(camera_position), std::log(other)});
    hypotheses[0].log_weight = std::log(1.0 - other);
  }

  void accept(double stamp, const FilterView& view) {
    stamp_sec = stamp;
    camera_position = view.T_odom_camera.translation();
    viewpoints.add(camera_position);
    outliers = 0;
    ++updates;
    normalise();
    prune();
    split();
    normalise();
  }

  bool isInOrder(double stamp) {
    if (!std::isfinite(stamp)) return false;
    if (hypotheses.empty()) return true;
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
        !geometry::isFinite(window.corners) || !geometry::isConvex(window.corners))
      return false;
    const Eigen::Vector3d up = T_odom_camera.linear().transpose().col(2);
    const auto ordered = upright(window, up);
    const auto image = ImageMeasurement::make(ordered, camera, noiseAt(T_odom_camera.translation()));
    const auto image_alone = ImageMeasurement::make(ordered, camera, noise());
    if (!image || !image_alone) return false;
    const auto size = estimate ? estimate->opening : opening;
    const FilterView view{*image, camera, size, T_odom_camera},
        alone{*image_alone, camera, size, T_odom_camera};
    if (hypotheses.empty()) return estimate && start(*estimate, alone);
    if (estimate && mean_squares > params.max_mean_squares) return start(*estimate, alone);
    if (apply(view, alone, window.stamp_sec)) {
      accept(window.stamp_sec, view);
      return true;
    }
    if (++outliers < params.outliers_until_restart) return false;
    return estimate && start(*estimate, alone);
  }
};

WindowFilter::WindowFilter(const FilterParams& params) {
  const auto faults = parameters::outOfRange(params);
  if (!faults.empty()) throw std::invalid_argument("filter parameters: " + parameters::joined(faults));
  impl_.reset(new Impl{params});
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
  if (self.hypotheses.empty() || !std::isfinite(now_sec)) return std::nullopt;
  const double age = now_sec - self.stamp_sec;
  if (age > self.params.max_age_sec || age < -self.params.time_jump_sec) return std::nullopt;
  WindowHypothesis window = self.hypotheses.front().window;
  window.predict(self.params, std::max(age, 0.0), self.camera_position, self.camera_position);

  FilteredWindow out;
  out.stamp_sec = self.stamp_sec;
  out.T_odom_window = window.T_odom_window();
  out.covariance.topLeftCorner<3, 3>() = window.covariance().topLeftCorner<3, 3>();
  out.covariance.topRightCorner<3, 1>() = window.covariance().block<3, 1>(0, WindowHypothesis::kYaw);
  out.covariance.bottomLeftCorner<1, 3>() = out.covariance.topRightCorner<3, 1>().transpose();
  out.covariance(3, 3) = out.covariance(4, 4) = std::pow(self.params.attitude_bias_sigma_rad, 2);
  out.covariance(5, 5) = window.covariance()(WindowHypothesis::kYaw, WindowHypothesis::kYaw);
  out.hypothesis_weight = std::exp(self.hypotheses.front().log_weight);
  out.updates = self.updates;
  const bool other_cannot_matter =
      self.hypotheses.size() < 2 ||
      std::abs(geometry::wrapAngle(self.hypotheses[0].window.state()(WindowHypothesis::kYaw) -
                                   self.hypotheses[1].window.state()(WindowHypothesis::kYaw))) <
          self.params.harmless_yaw_rad;
  out.sign_trusted = other_cannot_matter && window.yawSigma() < self.params.trusted_yaw_sigma_rad;
  return out;
}

std::optional<geometry::Quadrilateral> WindowFilter::predictedCorners(
    double now_sec, const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_odom_camera) const {
  if (!state(now_sec) || !geometry::isValidPose(T_odom_camera)) return std::nullopt;
  return geometry::projectOpening(camera, impl_->hypotheses.front().window.T_camera_window(T_odom_camera),
                                  impl_->opening);
}

void WindowFilter::reset() { impl_->reset(); }

}  // namespace window_ingress::pose
