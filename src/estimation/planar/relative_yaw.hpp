#pragma once

#include <Eigen/Geometry>

#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

/// Heading of the window's x axis against the camera's line of view, about `up_camera` [rad]; positive to the
/// left.
struct RelativeYaw {
  double yaw_rad = 0.0;
  Eigen::Vector3d by_rotation = Eigen::Vector3d::Zero();  ///< about the camera's fixed axes
};

RelativeYaw relativeYaw(const Eigen::Matrix3d& R_camera_window, const Eigen::Vector3d& up_camera);

/// Heading of the window's x axis against the line of sight to its centre, both seen along `up_camera` [rad];
/// positive to the left. 0 if one of them is vertical.
double yawFromSight(const Eigen::Isometry3d& T_camera_window, const Eigen::Vector3d& up_camera);

/// Spread of the relative yaw from its covariance, or infinity if the covariance is not usable.
double yawSigma(const RelativeYaw& yaw, const Matrix6d& covariance);

/// Spread of the yaw for an unknown size of the opening, from the image without gravity: width and height
/// become parameters. Their common scale cannot be separated from the distance and does not affect the yaw,
/// so the height is fixed and the width is free. Infinity if the image does not determine it.
double yawSigmaOfUnknownSize(const RefinementProblem& problem, const Eigen::Isometry3d& T_camera_window,
                             const RelativeYaw& yaw);

/// The same problem with an opening whose width is unknown.
RefinementProblem withFreeWidth(const RefinementProblem& problem);

}  // namespace window_ingress::estimation
