/// What goes into and comes out of the navigator.
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::navigation {

/// Odometry of the vehicle.
struct VehicleState {
  double stamp_sec = 0.0;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
};

/// The window in the odometry frame, filtered over time.
struct TargetEstimate {
  double stamp_sec = 0.0;                                           ///< of the last image that contributed
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();  ///< upright: yaw and position only
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< odom axes; m, rad
  /// The window's normal is unambiguous. While false, only the bearing of the position may be used.
  bool sign_trusted = false;
  int updates = 0;  ///< images that contributed since the window was last acquired
  geometry::OpeningSize opening;
};

/// Velocity wish for the vehicle: odometry axes, yaw rate about z.
struct Setpoint {
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double yaw_rate_radps = 0.0;
};

}  // namespace window_ingress::navigation
