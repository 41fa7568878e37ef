/// Inputs and outputs of the navigator.
#pragma once

#include <Eigen/Geometry>

#include "window_ingress/estimation/target_estimate.hpp"

namespace window_ingress::navigation {

/// Odometry of the vehicle.
struct VehicleState {
  double stamp_sec = 0.0;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_odom_radps = Eigen::Vector3d::Zero();  ///< zero if not reported
};

using estimation::TargetEstimate;

/// Commanded velocity: odometry axes, yaw rate about z.
struct Setpoint {
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double yaw_rate_radps = 0.0;
  double heading_error_rad = 0.0;  ///< of the reported heading; subtract before turning to body axes
};

}  // namespace window_ingress::navigation
