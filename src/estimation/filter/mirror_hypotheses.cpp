#include "estimation/filter/mirror_hypotheses.hpp"

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

}  // namespace window_ingress::estimation
