#pragma once

#include <Eigen/Geometry>

#include "window_ingress/pose/window_pose_estimate.hpp"

namespace window_ingress::pose {

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

}  // namespace window_ingress::pose
