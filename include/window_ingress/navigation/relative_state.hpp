#pragma once

#include <Eigen/Core>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// The vehicle's state in the window frame and its uncertainty. In front of the window x is negative.
struct RelativeState {
  Eigen::Vector3d position_window_m = Eigen::Vector3d::Zero();    ///< the body's centre
  Eigen::Vector3d velocity_window_mps = Eigen::Vector3d::Zero();  ///< relative to the window, in its axes
  double bearing_rad = 0.0;        ///< of the opening's centre against the vehicle's heading, left positive
  double heading_error_rad = 0.0;  ///< window's normal against the vehicle's heading, left positive
  double sigma_lateral_m = 0.0;    ///< of y now or at the plane, where a wrong heading shows; the larger one
  double sigma_vertical_m = 0.0;   ///< of z

  double distance() const {
    return -position_window_m.x();
  }  ///< to the window's plane, positive in front [m]
  double lateral() const { return position_window_m.y(); }
  double vertical() const { return position_window_m.z(); }
};

/// \param vehicle and \param target finite, in the same odometry frame
RelativeState relate(const VehicleState& vehicle, const TargetEstimate& target);

/// Rotation from window to odom axes by the window's heading alone.
Eigen::Matrix3d uprightRotation(const TargetEstimate& target);

/// Nose-down pitch of the vehicle [rad].
double pitchOf(const VehicleState& vehicle);

}  // namespace window_ingress::navigation
