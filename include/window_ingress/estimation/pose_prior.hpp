/// What is known beside the image: which way is up, and where the window is expected.
#pragma once

#include <Eigen/Geometry>

#include "window_ingress/estimation/window_pose_estimate.hpp"

namespace window_ingress::estimation {

/// Direction of "up" in the camera at the exposure, a soft prior: it never chooses between the two planar
/// solutions.
struct GravityPrior {
  Eigen::Vector3d up_camera = Eigen::Vector3d(0, -1, 0);  ///< unit vector, optical frame
  double sigma_rad = 0.02;                                ///< of the attitude, mounting included
};

/// True if the prior can be used: finite, a direction, a spread of more than 1e-6 rad.
inline bool isUsable(const GravityPrior& prior) {
  return prior.up_camera.allFinite() && prior.up_camera.norm() > 1e-6 && prior.sigma_rad > 1e-6 &&
         prior.sigma_rad < 1e6;
}

/// Cross product of the window's up with gravity's, weighted; and by rotation about the camera's axes.
struct GravityResidual {
  Eigen::Vector3d residual;
  Eigen::Matrix3d by_rotation;
};
GravityResidual gravityResidual(const GravityPrior& prior, const Eigen::Matrix3d& R_camera_window);

/// Where the window is expected in the camera, from elsewhere: with it two or three visible sides are enough
/// for a pose.
struct PosePrior {
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();
  Matrix6d covariance = Matrix6d::Identity();  ///< camera axes; x, y, z [m], rotations [rad]
};

/// A valid pose and a positive definite covariance.
bool isUsable(const PosePrior& prior);

/// Deviation of a pose from the prior's, whitened; by the pose as in `moved`.
struct PriorResidual {
  Eigen::Matrix<double, 6, 1> residual;
  Matrix6d by_pose;
};
PriorResidual priorResidual(const PosePrior& prior, const Eigen::Isometry3d& T_camera_window);

}  // namespace window_ingress::estimation
