#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::estimation {

/// Covariance of a pose: x, y, z [m], then rotations about the fixed x, y, z axes of the parent frame [rad]
/// (the order of geometry_msgs/PoseWithCovariance).
using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// One of the two poses that explain a planar rectangle.
struct PlanarSolution {
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Zero();  ///< in the camera frame
  double reprojection_rms_px = 0.0;        ///< per coordinate, of the four corners
  /// Half the sum of squared, sigma-weighted residuals of image and size.
  double cost = 0.0;
  geometry::OpeningSize opening;                                     ///< the size at which it fits best
  Eigen::Matrix2d opening_log_covariance = Eigen::Matrix2d::Zero();  ///< of (log width, log height)
};

/// Width over height of the opening.
struct MeasuredAspect {
  double ratio = 0.0;
  double sigma = 0.0;
};

/// Pose of the window relative to the camera, from one image.
struct WindowPoseEstimate {
  double stamp_sec = 0.0;
  PlanarSolution best;                        ///< the likelier of the two
  std::optional<PlanarSolution> alternative;  ///< the other local minimum, where there is one

  /// Heading of the window's axis against the camera's, about the vertical (gravity's if known, else the
  /// camera's own): 0 when square to the window, positive when the window's axis points to the left of the
  /// camera's.
  double yaw_rad = 0.0;
  double yaw_sigma_rad = 0.0;  ///< with the opening's size known
  /// Heading of the window's axis against the horizontal line of sight to the window's centre: 0 on the axis.
  /// The two planar solutions differ in its sign, which gives the side to which the vehicle must move.
  double yaw_from_sight_rad = 0.0;
  /// Spread of the yaw with the opening's size unknown, i.e. from keystone alone; decides about the sign.
  double sigma_u_rad = 0.0;
  double log_likelihood_ratio = 0.0;  ///< best over alternative, >= 0; 1e9 stands for infinity
  /// The signs of yaw_rad and of yaw_from_sight_rad are known: sigma_u is less than a third of either, and
  /// the likelihood ratio confirms it.
  bool sign_trusted = false;

  geometry::OpeningSize opening;  ///< size used for the pose: known, or of best fit
  Eigen::Matrix2d opening_log_covariance = Eigen::Matrix2d::Zero();  ///< of (log width, log height)

  /// Width over height as measured in this image alone, without prior knowledge; only from a whole view.
  std::optional<MeasuredAspect> aspect;

  geometry::EulerAngles euler;    ///< the paper's angles of R_camera_window, taken in forward-left-up axes
  double opening_width_m = 0.0;   ///< apparent width from here, largest when square to the window
  double opening_height_m = 0.0;  ///< apparent height from here
  double left_side_px = 0.0;      ///< length of the left border in the undistorted image
  double right_side_px = 0.0;     ///< length of the right border in the undistorted image
};

}  // namespace window_ingress::estimation
