#include "estimation/filter/mirror_hypotheses.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kMergeDistance = 0.5;   // squared Mahalanobis
constexpr double kSplitSigmas = 1.0;     // above this a mirror image is a separate mode
constexpr double kMaxEvidence = 3.0;     // of one image for one hypothesis against the other [nats]
constexpr double kMinWeight = 0.001;     // a lighter hypothesis is dropped
constexpr double kHarmlessYawRad = 0.1;  // hypotheses closer than this need not be distinguished
constexpr double kImpossible = -1e300;

/// True if an applied image is close enough to what the belief expected.
bool passesGate(const std::optional<WindowHypothesis::Outcome>& outcome, const FilterParams& params) {
  return outcome && outcome->squares <= params.nis_gate;
}

double upperTail(double sigmas) { return 0.5 * std::erfc(sigmas / std::sqrt(2.0)); }

CameraTurn cameraTurn(const WindowHypothesis& window) {
  constexpr auto kYaw = WindowState::kYawBias, kHeading = WindowState::kHeadingBias;
  const auto& values = window.state().values;
  const auto& covariance = window.covariance();
  const double together =
      covariance(kYaw, kYaw) + covariance(kHeading, kHeading) - 2.0 * covariance(kYaw, kHeading);
  return {-values.segment<3>(WindowState::kPitchBias),
          covariance.block<3, 3>(WindowState::kPitchBias, WindowState::kPitchBias),
          values(kHeading) - values(kYaw), std::sqrt(std::max(0.0, together))};
}

Matrix6d covarianceOf(const WindowHypothesis& window, const FilterParams& params) {
  const Eigen::Matrix4d pose = window.poseCovariance();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = pose.topLeftCorner<3, 3>();
  covariance.topRightCorner<3, 1>() = pose.topRightCorner<3, 1>();
  covariance.bottomLeftCorner<1, 3>() = pose.bottomLeftCorner<1, 3>();
  covariance(3, 3) = covariance(4, 4) = std::pow(params.attitude_bias_sigma_rad, 2);
  covariance(5, 5) = pose(3, 3);
  return covariance;
}

TargetMotion motionOf(const WindowHypothesis& window, const MotionModel& model) {
  if (model.stands()) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(window.velocityCovariance(),
                                                              Eigen::EigenvaluesOnly);
  return {model, window.state().velocity(), std::sqrt(std::max(0.0, spread.eigenvalues().maxCoeff()))};
}

}  // namespace

bool MirrorHypotheses::start(const Eigen::Isometry3d& T_odom_window, const SizeEstimate& size,
                             const YawBias& yaw_bias, const FilterView& view) {
  const Eigen::Vector3d position = view.T_odom_camera.translation();
  WindowHypothesis window(params_, T_odom_window, size, yaw_bias, position);
  auto outcome = window.update(params_, view);
  if (!passesGate(outcome, params_)) {
    window = WindowHypothesis(params_, window.mirrored(position).T_odom_window(), size, yaw_bias, position);
    outcome = window.update(params_, view);
  }
  if (!passesGate(outcome, params_)) return false;
  hypotheses_.assign(1, {window, 0.0});
  may_split_ = true;
  addMirrorImage(view, size, yaw_bias, outcome->squares);
  settle(position);
  return true;
}

// Searches the alternative again, because a free fit may lack one that an upright window has. Where noise has
// flattened its minimum, its probability mass is still there. Then the mirrored first belief represents it.
void MirrorHypotheses::addMirrorImage(const FilterView& view, const SizeEstimate& size,
                                      const YawBias& yaw_bias, double squares) {
  const WindowHypothesis& window = hypotheses_.front().window;
  const Eigen::Vector3d position = view.T_odom_camera.translation();
  const Eigen::Isometry3d image = window.mirrored(position).T_odom_window();
  WindowHypothesis other(params_, image, size, yaw_bias, position);
  auto outcome = other.update(params_, view);
  if (!outcome || window.distanceTo(other) < kMergeDistance) {
    if (std::abs(window.yawFromSight(position)) < kSplitSigmas * window.yawFromSightSigma(position)) return;
    other = window.mirrored(position);
    outcome = other.update(params_, view);
  }
  if (!outcome) return;
  const double evidence = 0.5 * (squares - outcome->squares);
  hypotheses_.push_back({other, std::clamp(evidence, -kMaxEvidence, kMaxEvidence)});
}

std::optional<WindowHypothesis::Outcome> MirrorHypotheses::apply(const FilterView& view, double elapsed_sec,
                                                                 double way_m) {
  std::vector<Weighted> tried = hypotheses_;
  std::array<double, 2> evidence{kImpossible, kImpossible};
  std::optional<WindowHypothesis::Outcome> closest;
  for (std::size_t i = 0; i < tried.size(); ++i) {
    WindowHypothesis& window = tried[i].window;
    window.predict(params_, elapsed_sec, way_m, view.T_odom_camera.translation());
    WindowHypothesis updated = window;
    const auto outcome = updated.update(params_, view);
    if (!passesGate(outcome, params_)) continue;
    evidence[i] = outcome->log_evidence;
    window = updated;
    if (!closest || outcome->squares < closest->squares) closest = outcome;
  }
  if (!closest) return std::nullopt;
  const double best = std::max(evidence[0], evidence[1]);
  for (std::size_t i = 0; i < tried.size(); ++i)
    tried[i].log_weight += std::max(evidence[i] - best, -kMaxEvidence);
  hypotheses_ = std::move(tried);
  settle(view.T_odom_camera.translation());
  return closest;
}

bool MirrorHypotheses::areUnambiguous() const {
  if (hypotheses_.size() < 2) return true;
  const auto yaw = [](const Weighted& h) { return h.window.state().yaw(); };
  return std::abs(geometry::wrapAngle(yaw(hypotheses_[0]) - yaw(hypotheses_[1]))) < kHarmlessYawRad;
}

void MirrorHypotheses::settle(const Eigen::Vector3d& camera_position) {
  normalise();
  mergeOrDrop();
  split(camera_position);
  normalise();
}

void MirrorHypotheses::normalise() {
  std::sort(hypotheses_.begin(), hypotheses_.end(),
            [](const Weighted& a, const Weighted& b) { return a.log_weight > b.log_weight; });
  const double heaviest = hypotheses_.front().log_weight;
  double sum = 0.0;
  for (const auto& h : hypotheses_) sum += std::exp(h.log_weight - heaviest);
  for (auto& h : hypotheses_) h.log_weight -= heaviest + std::log(sum);
}

void MirrorHypotheses::mergeOrDrop() {
  if (hypotheses_.size() < 2) return;
  const double share = std::exp(hypotheses_[1].log_weight);
  if (hypotheses_[0].window.distanceTo(hypotheses_[1].window) < kMergeDistance) {
    hypotheses_[0].window = hypotheses_[0].window.mergedWith(hypotheses_[1].window, share);
    hypotheses_.pop_back();
    may_split_ = true;
  } else if (share < kMinWeight) {
    hypotheses_.pop_back();
    may_split_ = false;
  }
}

// A single belief between both mirror images contains part of the other one's probability mass, so it is
// split.
void MirrorHypotheses::split(const Eigen::Vector3d& camera_position) {
  if (hypotheses_.size() != 1 || !may_split_) return;
  const WindowHypothesis window = hypotheses_.front().window;
  const double angle = std::abs(window.yawFromSight(camera_position));
  const double sigmas = angle / window.yawFromSightSigma(camera_position);
  if (2.0 * angle < kHarmlessYawRad || sigmas < kSplitSigmas) return;
  const double other = upperTail(sigmas);
  if (other < kMinWeight) return;
  hypotheses_ = {{window, std::log(1.0 - other)}, {window.mirrored(camera_position), std::log(other)}};
}

FilteredWindow MirrorHypotheses::windowAt(double age_sec, const Eigen::Vector3d& camera_position,
                                          double unlearned_yaw_rad) const {
  const auto predicted = [&](WindowHypothesis window) {
    window.predict(params_, std::max(age_sec, 0.0), 0.0, camera_position);
    window.addTurn(unlearned_yaw_rad, camera_position);
    return window;
  };
  const Weighted &first = hypotheses_.front(), &last = hypotheses_.back();
  const bool is_merged = hypotheses_.size() > 1 && areUnambiguous();
  const WindowHypothesis window =
      predicted(is_merged ? first.window.mergedWith(last.window, std::exp(last.log_weight)) : first.window);
  FilteredWindow out;
  out.age_sec = age_sec;
  out.T_odom_window = window.T_odom_window();
  out.covariance = covarianceOf(window, params_);
  out.hypothesis_weight = std::exp(first.log_weight);
  out.sign_trusted =
      areUnambiguous() && window.yawFromSightSigma(camera_position) < params_.trusted_yaw_sigma_rad;
  if (hypotheses_.size() > 1) {
    const WindowHypothesis other = predicted(last.window);
    out.alternative =
        FilteredWindow::Alternative{other.T_odom_window(), covarianceOf(other, params_), cameraTurn(other)};
  }
  out.size = window.size();
  out.camera_turn = cameraTurn(window);
  out.motion = motionOf(window, params_.targetMotion());
  return out;
}

}  // namespace window_ingress::estimation
