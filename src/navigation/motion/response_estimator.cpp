#include "navigation/motion/response_estimator.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace window_ingress::navigation {
namespace {

constexpr std::array<double, 7> kResponsesSec{0.12, 0.17, 0.24, 0.33, 0.46, 0.64, 0.9};
constexpr std::array<double, 5> kAccelerationsMps2{std::numeric_limits<double>::infinity(), 1.4, 1.0, 0.7,
                                                   0.5};
constexpr std::array<double, 2> kPullsHz{0.0, 0.36};  // none, and that of a measured autopilot
constexpr double kMinDeadTimeSec = 0.1, kMinLagSec = 0.02;
constexpr double kOffsetSec = 3.0, kErrorSec = 12.0, kChangeSec = 0.5;
constexpr double kExplains = 0.7;       // of the mean square that a vehicle which stands would leave
constexpr double kClearlyBetter = 0.9;  // of the mean square of the one chosen so far

}  // namespace

double share(double dt_sec, double time_constant_sec) {
  return time_constant_sec > 0.0 ? 1.0 - std::exp(-dt_sec / time_constant_sec) : 1.0;
}

ResponseEstimator::ResponseEstimator(double assumed_sec) : assumed_sec_(assumed_sec) { reset(); }

void ResponseEstimator::reset() {
  models_.clear();
  for (const double pull_hz : kPullsHz)
    for (const double acceleration_mps2 : kAccelerationsMps2) {
      models_.push_back({assumed_sec_, acceleration_mps2, pull_hz});
      for (const double response_sec : kResponsesSec)
        models_.push_back({response_sec, acceleration_mps2, pull_hz});
    }
  models_.push_back({assumed_sec_, 0.0, 0.0});  // stands, whatever it is told
  best_ = 0;
  excitation_ = 0.0;
  is_started_ = false;
}

void ResponseEstimator::update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps,
                               double dt_sec) {
  if (!measured_mps.allFinite() || !commanded_mps.allFinite() || !(dt_sec > 0.0)) return;
  if (!is_started_) {
    for (Model& model : models_) {
      model.velocity_mps = measured_mps - model.offset_mps;
      model.behind_m.setZero();
    }
    commands_.clear();
    usual_command_mps_ = commanded_mps;
    is_started_ = true;
  }
  const Eigen::Vector3d asked_mps = delayed(commanded_mps, dt_sec);
  const Eigen::Vector3d new_mps = commanded_mps - usual_command_mps_;
  usual_command_mps_ += share(dt_sec, kChangeSec) * new_mps;
  excitation_ += dt_sec * new_mps.squaredNorm();
  for (Model& model : models_) {
    const double lag_sec = std::max(kMinLagSec, model.response_sec - kMinDeadTimeSec);
    const Eigen::Vector3d wished_mps = asked_mps + model.pull_hz * model.behind_m;
    Eigen::Vector3d change_mps = share(dt_sec, lag_sec) * (wished_mps - model.velocity_mps);
    const double most_mps = model.acceleration_mps2 * dt_sec;
    const double size_mps = change_mps.norm();
    if (size_mps > most_mps) change_mps *= most_mps / size_mps;
    model.velocity_mps += change_mps;
    model.behind_m += dt_sec * (asked_mps - model.velocity_mps);
    const Eigen::Vector3d remains_mps = measured_mps - model.velocity_mps - model.offset_mps;
    model.offset_mps += share(dt_sec, kOffsetSec) * remains_mps;
    model.error += share(dt_sec, kErrorSec) * (remains_mps.squaredNorm() - model.error);
  }
  choose();
}

// The setpoint that the vehicle has begun to answer by now.
Eigen::Vector3d ResponseEstimator::delayed(const Eigen::Vector3d& commanded_mps, double dt_sec) {
  now_sec_ += dt_sec;
  commands_.push_back({now_sec_, commanded_mps});
  while (commands_.size() > 1 && commands_[1].sec <= now_sec_ - kMinDeadTimeSec) commands_.pop_front();
  return commands_.front().velocity_mps;
}

void ResponseEstimator::choose() {
  if (!isMeasured()) return;
  const auto better = [](const Model& a, const Model& b) { return a.error < b.error; };
  const Model& standing = models_.back();
  const auto least = std::min_element(models_.begin(), std::prev(models_.end()), better);
  if (least->error < kExplains * standing.error && least->error < kClearlyBetter * models_[best_].error)
    best_ = static_cast<std::size_t>(least - models_.begin());
}

}  // namespace window_ingress::navigation
