#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::pose {

/// Covariance of a pose: x, y, z [m], then rotations about the fixed x, y, z axes of the parent frame [rad]
/// (the order of geometry_msgs/PoseWithCovariance).
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One of the two poses that explain a planar rectangle.
struct PlanarSolution {
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< in the camera frame
  double reprojection_rms_px = 0.0;        ///< per coordinate, of the four corners
  double cost = 0.0;                       ///< half the sum of squared, sigma-weighted residuals
};

/// Pose of the window relative to the camera, from one image.
struct WindowPoseEstimate {
  double stamp_sec = 0.0;
  PlanarSolution best;                        ///< the likelier of the two
  std::optional<PlanarSolution> alternative;  ///< the other local minimum, where there is one

  /// Heading of the window's axis against the camera's, about the vertical (gravity's if known, else the
  /// camera's own): 0 when square to it, positive when the window's axis points to the left of the camera's.
  double yaw_rad = 0.0;
  double yaw_sigma_rad = 0.0;  ///< with the opening's size known
  /// Spread of the yaw with the opening's size unknown, i.e. from keystone alone. It decides about the sign.
  double sigma_u_rad = 0.0;
  double log_likelihood_ratio = 0.0;  ///< best over alternative, >= 0; infinite is written as 1e9
  /// The sign of yaw_rad is certain: sigma_u < |yaw| / 3, and the image has indeed shown it (likelihood
  /// ratio).
  bool sign_trusted = false;

  geometry::OpeningSize opening;  ///< the size that was taken as known

  geometry::EulerAngles euler;   ///< the paper's angles of R_camera_window, taken in forward-left-up axes
  double opening_width_m = 0.0;  ///< apparent: as wide as seen from here, largest when square to it
  double left_side_px = 0.0;     ///< length of the left border in the undistorted image
  double right_side_px = 0.0;    ///< length of the right border in the undistorted image
};

}  // namespace window_ingress::pose
