#pragma once

#include <Eigen/Geometry>

#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// The camera's pose and motion at an image's stamp. Its velocities are assumed constant for the few
/// milliseconds around the stamp.
struct CameraTruth {
  Eigen::Isometry3d T_window_camera = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_window_mps = Eigen::Vector3d::Zero();  ///< of the camera's centre
  Eigen::Vector3d angular_velocity_camera_radps = Eigen::Vector3d::Zero();

  /// Truth of a camera on a vehicle; `T_odom_window` is in the same odom axes as `truth`.
  static CameraTruth of(const VehicleTruth& truth, const Eigen::Isometry3d& T_odom_window,
                        const Eigen::Isometry3d& T_base_camera);

  /// Truth of a camera at the same place with other axes.
  CameraTruth turned(const Eigen::Matrix3d& R_turned_camera) const;

  /// Pose this long after the stamp; negative: before it.
  Eigen::Isometry3d T_camera_window(double after_sec) const;

  /// Upper bound of the image motion during `duration_sec` [px], for objects at least as far as the window's
  /// plane, and not nearer than 0.5 m.
  double greatestShift(const geometry::PinholeCamera& camera, double duration_sec) const;
};

}  // namespace window_ingress::simulation
