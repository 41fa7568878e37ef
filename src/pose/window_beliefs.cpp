#include "window_ingress/pose/window_beliefs.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::pose {
namespace {

constexpr double kMergeDistance = 0.5;  // squared Mahalanobis
constexpr double kSplitSigmas = 1.0;    // from here on a mirror image is a mode of its own
constexpr double kImpossible = -1e300;

double upperTail(double sigmas) { return 0.5 * std::erfc(sigmas / std::sqrt(2.0)); }

}  // namespace

bool WindowBeliefs::start(const Eigen::Isometry3d& T_odom_window, const FilterView& view) {
  const Eigen::Vector3d position = view.T_odom_camera.translation();
  WindowHypothesis window(params_, T_odom_window);
  auto outcome = window.update(params_, view);
  if (!outcome || outcome->squares > params_.gate_squares) {
    window = WindowHypothesis(params_, window.mirrored(position).T_odom_window());
    outcome = window.update(params_, view);
  }
  if (!outcome || outcome->squares > params_.gate_squares) return false;
  hypotheses_.assign(1, {window, 0.0});
  may_split_ = true;
  addMirrorImage(view, outcome->squares);
  settle(position);
  return true;
}

// The alternative of a free fit may be missing where that of an upright window is not, so it is sought anew.
// Where noise has levelled its minimum, its mass is still there: it is then held by the spread of the first
// belief.
void WindowBeliefs::addMirrorImage(const FilterView& view, double squares) {
  const WindowHypothesis& window = hypotheses_.front().window;
  const Eigen::Vector3d position = view.T_odom_camera.translation();
  const Eigen::Isometry3d image = window.mirrored(position).T_odom_window();
  WindowHypothesis other(params_, image);
  auto outcome = other.update(params_, view);
  if (!outcome || window.distanceTo(other) < kMergeDistance) {
    if (std::abs(window.yawFromSight(position)) < kSplitSigmas * window.yawSigma()) return;
    other = WindowHypothesis(params_, image, window.yawSigma());
    outcome = other.update(params_, view);
  }
  if (!outcome) return;
  const double evidence = 0.5 * (squares - outcome->squares);
  hypotheses_.push_back({other, std::clamp(evidence, -params_.max_evidence, params_.max_evidence)});
}

std::optional<double> WindowBeliefs::apply(const FilterView& view, const FilterView& alone,
                                           double elapsed_sec, const Eigen::Vector3d& camera_from) {
  std::vector<Weighted> tried = hypotheses_;
  std::vector<double> evidence;
  std::optional<double> least_squares;
  for (auto& [window, log_weight] : tried) {
    window.predict(params_, elapsed_sec, camera_from, view.T_odom_camera.translation());
    WindowHypothesis updated = window, updated_alone = window;
    const auto outcome = updated.update(params_, view);
    const auto outcome_alone = updated_alone.update(params_, alone);
    const bool inside = outcome && outcome_alone && outcome_alone->squares <= params_.gate_squares;
    evidence.push_back(inside ? outcome->log_evidence : kImpossible);
    if (!inside) continue;
    window = updated;
    least_squares = std::min(least_squares.value_or(outcome_alone->squares), outcome_alone->squares);
  }
  if (!least_squares) return std::nullopt;
  const double best = *std::max_element(evidence.begin(), evidence.end());
  for (std::size_t i = 0; i < tried.size(); ++i)
    tried[i].log_weight += std::max(evidence[i] - best, -params_.max_evidence);
  hypotheses_ = std::move(tried);
  settle(view.T_odom_camera.translation());
  return least_squares;
}

bool WindowBeliefs::areUnambiguous() const {
  if (hypotheses_.size() < 2) return true;
  const auto yaw = [](const Weighted& h) { return h.window.state()(WindowHypothesis::kYaw); };
  return std::abs(geometry::wrapAngle(yaw(hypotheses_[0]) - yaw(hypotheses_[1]))) < params_.harmless_yaw_rad;
}

void WindowBeliefs::settle(const Eigen::Vector3d& camera_position) {
  normalise();
  mergeOrDrop();
  split(camera_position);
  normalise();
}

void WindowBeliefs::normalise() {
  std::sort(hypotheses_.begin(), hypotheses_.end(),
            [](const Weighted& a, const Weighted& b) { return a.log_weight > b.log_weight; });
  const double heaviest = hypotheses_.front().log_weight;
  double sum = 0.0;
  for (const auto& h : hypotheses_) sum += std::exp(h.log_weight - heaviest);
  for (auto& h : hypotheses_) h.log_weight -= heaviest + std::log(sum);
}

void WindowBeliefs::mergeOrDrop() {
  if (hypotheses_.size() < 2) return;
  const double share = std::exp(hypotheses_[1].log_weight);
  if (hypotheses_[0].window.distanceTo(hypotheses_[1].window) < kMergeDistance) {
    hypotheses_[0].window = hypotheses_[0].window.mergedWith(hypotheses_[1].window, share);
    hypotheses_.pop_back();
    may_split_ = true;
  } else if (share < params_.dead_weight) {
    hypotheses_.pop_back();
    may_split_ = false;
  }
}

// A single belief that lies between both mirror images holds some of the other one's mass: it becomes two.
void WindowBeliefs::split(const Eigen::Vector3d& camera_position) {
  if (hypotheses_.size() != 1 || !may_split_) return;
  const WindowHypothesis window = hypotheses_.front().window;
  const double angle = std::abs(window.yawFromSight(camera_position)), sigmas = angle / window.yawSigma();
  if (2.0 * angle < params_.harmless_yaw_rad || sigmas < kSplitSigmas) return;
  const double other = upperTail(sigmas);
  if (other < params_.dead_weight) return;
  hypotheses_ = {{window, std::log(1.0 - other)}, {window.mirrored(camera_position), std::log(other)}};
}

}  // namespace window_ingress::pose
