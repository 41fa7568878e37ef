#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace window_ingress::navigation {

/// Of a step that a first order lag has followed after `dt_sec`.
double share(double dt_sec, double time_constant_sec);

/// How the vehicle's velocity follows its setpoints, measured in flight: of models with a dead time and
/// different time constants and limits of acceleration, all fed with the setpoints that were sent, the one
/// whose velocity is most like the measured one. Half of them make up for the way by which they are behind
/// their setpoints, as some autopilots do: what these overshoot by and creep back is no wind. A steady
/// difference (wind, a biased velocity) counts for nothing: each model learns its own and is judged by what
/// remains. Where none explains the motion (turned axes, a vehicle that is held), what was assumed stays.
class ResponseEstimator {
 public:
  /// \param assumed_sec is believed until the vehicle has been asked to change its velocity often enough to
  /// tell
  explicit ResponseEstimator(double assumed_sec);

  /// \param measured_mps of the vehicle, \param commanded_mps the setpoint before; both odom axes
  void update(const Eigen::Vector3d& measured_mps, const Eigen::Vector3d& commanded_mps, double dt_sec);
  /// The models start anew from the next measurement; what they showed stays.
  void restart() { is_started_ = false; }
  /// What was shown is forgotten, too.
  void reset();

  /// From a setpoint to the velocity following it [s]: 0.12 to 0.9 s, or as assumed.
  double responseSec() const { return models_[best_].response_sec; }
  /// The vehicle changes its velocity no faster; infinite where no limit has shown.
  double accelerationMps2() const { return models_[best_].acceleration_mps2; }
  bool isMeasured() const { return excitation_ >= kEnoughExcitation; }
  /// Velocity that the setpoints alone would have given the vehicle [m/s].
  const Eigen::Vector3d& velocity() const { return models_[best_].velocity_mps; }

 private:
  struct Model {
    double response_sec;  ///< dead time and time constant
    double acceleration_mps2;
    double pull_hz;  ///< velocity per way that it is behind
    Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
    Eigen::Vector3d behind_m = Eigen::Vector3d::Zero();  ///< of where the setpoints would have brought it
    Eigen::Vector3d offset_mps =
        Eigen::Vector3d::Zero();  ///< steady difference of the measured velocity from it
    double error = 0.0;           ///< mean square of what remains, fading [m^2/s^2]
  };
  static constexpr double kEnoughExcitation = 0.12;  ///< [m^2/s]

  Eigen::Vector3d delayed(const Eigen::Vector3d& commanded_mps, double dt_sec);
  void choose();

  double assumed_sec_;
  std::vector<Model> models_;
  std::size_t best_;
  struct Command {
    double sec;
    Eigen::Vector3d velocity_mps;
  };
  std::deque<Command> commands_;  ///< of the dead time
  double now_sec_ = 0.0;
  Eigen::Vector3d usual_command_mps_ = Eigen::Vector3d::Zero();
  double excitation_ = 0.0;  ///< how much the setpoints have changed so far [m^2/s]
  bool is_started_ = false;
};

}  // namespace window_ingress::navigation
