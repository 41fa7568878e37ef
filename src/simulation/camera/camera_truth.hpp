#pragma once

#include <Eigen/Geometry>

#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// Where the camera is at an image's stamp and how it moves then. For the few milliseconds around it the
/// velocities are constant.
struct CameraTruth {
  Eigen::Isometry3d T_window_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_window_mps = Eigen::Vector3d::Zero();  ///< of the camera's centre
  Eigen::Vector3d angular_velocity_camera_radps = Eigen::Vector3d::Zero();

  /// Of a camera on a vehicle; `T_odom_window` from the same odom axes as `truth`.
  static CameraTruth of(const VehicleTruth& truth, const Eigen::Isometry3d& T_odom_window,
                        const Eigen::Isometry3d& T_base_camera);

  /// Of a camera at the same place with axes of its own.
  CameraTruth turned(const Eigen::Matrix3d& R_turned_camera) const;

  /// So long after the stamp, or before it if negative.
  Eigen::Isometry3d T_camera_window(double after_sec) const;

  /// The most that anything moves in the image during `duration_sec`, taken to be at least as far as the
  /// plane of the window, and no nearer than 0.5 m [px].
  double greatestShift(const geometry::PinholeCamera& camera, double duration_sec) const;
};

}  // namespace window_ingress::simulation
