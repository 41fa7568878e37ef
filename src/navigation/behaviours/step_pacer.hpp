#pragma once

#include <algorithm>
#include <optional>

#include "navigation/behaviours/behaviour.hpp"
#include "navigation/motion/stopping.hpp"

namespace window_ingress::navigation {

/// The paper's small steps (P19), as a reference for comparison: the vehicle moves by `step_m`, stops, looks,
/// and repeats. Each step is along one axis of the window only.
class StepPacer {
 public:
  explicit StepPacer(const NavigatorParams& params) : params_(&params) {}
  explicit StepPacer(NavigatorParams&&) = delete;  ///< the parameters must outlive this

  bool isStepped() const { return params_->scheme == "stepped"; }
  /// The wished velocity, unless the scheme is stepped: then the velocity of the present step, or zero during
  /// the pause. \param R_odom_window the window's axes
  Eigen::Vector3d pace(const Eigen::Vector3d& velocity_odom_mps, const Eigen::Matrix3d& R_odom_window,
                       const Situation& situation) {
    constexpr double kStandingMps = 0.1, kThereM = 0.02;
    if (!isStepped()) return velocity_odom_mps;
    const Eigen::Vector3d position = situation.vehicle->T_odom_base.translation();
    const double left_m = from_odom_m_ ? params_->align.step_m - (position - *from_odom_m_).norm() : 0.0;
    if (left_m > kThereM) return along(velocity_odom_mps, left_m);
    from_odom_m_.reset();
    const bool stands = situation.vehicle->velocity_odom_mps.norm() < kStandingMps;
    const double looked_sec = heldSec(stands, situation.now_sec, standing_since_sec_);
    if (!(looked_sec >= params_->align.step_pause_sec)) return Eigen::Vector3d::Zero();
    standing_since_sec_.reset();
    Eigen::Index axis;
    (R_odom_window.transpose() * velocity_odom_mps).cwiseAbs().maxCoeff(&axis);
    along_ = R_odom_window.col(axis);
    from_odom_m_ = position;
    return along(velocity_odom_mps, params_->align.step_m);
  }

 private:
  /// The wished velocity's component along the step, slow enough to stop at its end.
  Eigen::Vector3d along(const Eigen::Vector3d& velocity_odom_mps, double left_m) const {
    const double most_mps = stoppingSpeed(left_m, params_->vehicle);
    return std::clamp(velocity_odom_mps.dot(along_), -most_mps, most_mps) * along_;
  }

  const NavigatorParams* params_;
  std::optional<Eigen::Vector3d> from_odom_m_;       ///< start of the present step; empty during the pause
  Eigen::Vector3d along_ = Eigen::Vector3d::Zero();  ///< the present step's axis, odom
  std::optional<double> standing_since_sec_;
};

}  // namespace window_ingress::navigation
