#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <iterator>
#include <limits>
#include <vector>

namespace window_ingress::navigation {

/// Fraction of a step that a first-order lag has followed after `dt_sec`.
inline double share(double dt_sec, double time_constant_sec) {
  return time_constant_sec > 0.0 ? 1.0 - std::exp(-dt_sec / time_constant_sec) : 1.0;
}

/// Measures in flight how the velocity follows the setpoints. Models with a dead time and various time
/// constants and acceleration limits run on the sent setpoints; the one closest to the measured velocity is
/// chosen. Half of the models also catch up the way that they lag behind their setpoints, as some autopilots
/// do: their overshoot and slow return is not wind. Each model learns its own steady difference (wind, a
/// biased velocity) and is judged by the rest. If no model explains the motion (turned axes, a vehicle that
/// is held, more gusts than commands), the assumed response stays.
class ResponseEstimator {
 public:
  /// \param assumed_sec response until enough velocity changes were commanded to measure it
  explicit ResponseEstimator(double assumed_sec) : assumed_sec_(assumed_sec) { reset(); }

  /// \param measured_mps of the vehicle, \param commanded_mps the previous setpoint; both odom axes
  void update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps, double dt_sec) {
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

  /// The models restart from the next measurement; the chosen response stays.
  void restart() { is_started_ = false; }
  /// Restarts and forgets the chosen response.
  void reset() {
    models_.clear();
    for (const double pull_hz : kPullsHz)
      for (const double acceleration_mps2 : kAccelerationsMps2) {
        models_.push_back({assumed_sec_, acceleration_mps2, pull_hz});
        for (const double response_sec : kResponsesSec)
          models_.push_back({response_sec, acceleration_mps2, pull_hz});
      }
    models_.push_back({assumed_sec_, 0.0, 0.0});  // this model never moves
    best_ = 0;
    excitation_ = 0.0;
    is_started_ = is_measured_ = false;
  }

  /// Time from a setpoint to the velocity that follows it [s]: 0.12 to 0.9 s, or as assumed.
  double responseSec() const { return models_[best_].response_sec; }
  /// Acceleration limit of the vehicle; infinite if none was found.
  double accelerationMps2() const { return models_[best_].acceleration_mps2; }
  /// Whether a model explains the vehicle's motion.
  bool isMeasured() const { return is_measured_; }
  /// Velocity that the setpoints alone would have given the vehicle [m/s].
  const Eigen::Vector3d& velocity() const { return models_[best_].velocity_mps; }

 private:
  static constexpr std::array<double, 7> kResponsesSec{0.12, 0.17, 0.24, 0.33, 0.46, 0.64, 0.9};
  static constexpr std::array<double, 5> kAccelerationsMps2{std::numeric_limits<double>::infinity(), 1.4, 1.0,
                                                            0.7, 0.5};
  static constexpr std::array<double, 2> kPullsHz{0.0, 0.36};  // none, and that of a measured autopilot
  static constexpr double kMinDeadTimeSec = 0.1, kMinLagSec = 0.02;
  static constexpr double kOffsetSec = 3.0, kErrorSec = 12.0, kChangeSec = 0.5;
  static constexpr double kExplains = 0.7;       // fraction of the error of a model that never moves
  static constexpr double kClearlyBetter = 0.9;  // fraction of the error of the present choice

  struct Model {
    double response_sec;  ///< dead time plus time constant
    double acceleration_mps2;
    double pull_hz;  ///< extra velocity per distance behind
    Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
    Eigen::Vector3d behind_m = Eigen::Vector3d::Zero();  ///< distance behind the setpoints' way
    Eigen::Vector3d offset_mps =
        Eigen::Vector3d::Zero();  ///< steady difference of the measured velocity from `velocity_mps`
    double error = 0.0;           ///< mean square of the remaining difference, fading [m^2/s^2]
  };
  static constexpr double kEnoughExcitation = 0.12;  ///< [m^2/s]

  /// The setpoint that the vehicle has begun to answer by now.
  Eigen::Vector3d delayed(const Eigen::Vector3d& commanded_mps, double dt_sec) {
    now_sec_ += dt_sec;
    commands_.push_back({now_sec_, commanded_mps});
    while (commands_.size() > 1 && commands_[1].sec <= now_sec_ - kMinDeadTimeSec) commands_.pop_front();
    return commands_.front().velocity_mps;
  }

  void choose() {
    if (excitation_ < kEnoughExcitation) return;
    const auto better = [](const Model& a, const Model& b) { return a.error < b.error; };
    const Model& standing = models_.back();
    const auto least = std::min_element(models_.begin(), std::prev(models_.end()), better);
    if (!(least->error < kExplains * standing.error)) return;
    is_measured_ = true;
    if (least->error < kClearlyBetter * models_[best_].error)
      best_ = static_cast<std::size_t>(least - models_.begin());
  }

  double assumed_sec_;
  std::vector<Model> models_;
  std::size_t best_;
  struct Command {
    double sec;
    Eigen::Vector3d velocity_mps;
  };
  std::deque<Command> commands_;  ///< commands within the dead time
  double now_sec_ = 0.0;
  Eigen::Vector3d usual_command_mps_ = Eigen::Vector3d::Zero();
  double excitation_ = 0.0;  ///< how much the setpoints have changed so far [m^2/s]
  bool is_started_ = false, is_measured_ = false;
};

}  // namespace window_ingress::navigation
