#include "window_ingress/navigation/relative_state.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {

Eigen::Matrix3d uprightRotation(const TargetEstimate& target) {
  return geometry::yawRotation(geometry::yawOf(target.T_odom_window.linear()));
}

Eigen::Vector3d normalOf(const TargetEstimate& target) { return uprightRotation(target).col(0); }

double distanceBetween(const TargetEstimate& a, const TargetEstimate& b) {
  return (a.T_odom_window.translation() - b.T_odom_window.translation()).norm();
}

namespace {

/// To first order, a window that moves by dp and turns by dpsi about the vertical changes the vehicle's
/// lateral offset by -e_y . dp - x dpsi.
double lateralSigma(const Eigen::Matrix3d& R_odom_window, double x_m,
                    const Eigen::Matrix<double, 6, 6>& covariance) {
  Eigen::Matrix<double, 6, 1> jacobian = Eigen::Matrix<double, 6, 1>::Zero();
  jacobian.head<3>() = -R_odom_window.col(1);
  jacobian(5) = -x_m;
  return std::sqrt(std::max(0.0, jacobian.dot(covariance * jacobian)));
}

}  // namespace

RelativeState relate(const VehicleState& vehicle, const TargetEstimate& target) {
  const Eigen::Matrix3d R_odom_window = uprightRotation(target);
  const Eigen::Vector3d to_window_odom_m =
      target.T_odom_window.translation() - vehicle.T_odom_base.translation();
  const double heading_rad = geometry::yawOf(vehicle.T_odom_base.linear());
  RelativeState relative;
  relative.position_window_m = -(R_odom_window.transpose() * to_window_odom_m);
  relative.velocity_window_mps =
      R_odom_window.transpose() * (vehicle.velocity_odom_mps - target.motion.velocity_odom_mps);
  relative.bearing_rad =
      geometry::wrapAngle(std::atan2(to_window_odom_m.y(), to_window_odom_m.x()) - heading_rad);
  relative.heading_error_rad = geometry::wrapAngle(geometry::yawOf(R_odom_window) - heading_rad);
  const double x_m = relative.position_window_m.x();
  relative.sigma_m = {std::max(lateralSigma(R_odom_window, x_m, target.covariance),
                               lateralSigma(R_odom_window, 0.0, target.covariance)),
                      std::sqrt(std::max(0.0, target.covariance(2, 2)))};
  return relative;
}

double pitchOf(const VehicleState& vehicle) {
  return std::asin(std::clamp(-vehicle.T_odom_base.linear()(2, 0), -1.0, 1.0));
}

}  // namespace window_ingress::navigation
