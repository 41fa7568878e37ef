#pragma once

#include <Eigen/Geometry>

namespace window_ingress::simulation {

/// True state of the vehicle.
struct VehicleTruth {
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();  ///< axes of odom without its drift
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_base_radps = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::simulation
