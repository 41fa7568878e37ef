#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// The four corners in canonical order: x0, y0, x1, ... [px of the undistorted image of the same K].
using CornerVector = Eigen::Matrix<double, 8, 1>;

/// Predicted corners of the opening, with derivatives by the pose and by the opening's size.
struct PredictedOpening {
  CornerVector corners_px = CornerVector::Zero();
  /// By translation [px/m] and rotation about the camera's fixed axes, at the window's origin [px/rad].
  Eigen::Matrix<double, 8, 6> by_pose = Eigen::Matrix<double, 8, 6>::Zero();
  Eigen::Matrix<double, 8, 2> by_log_size =
      Eigen::Matrix<double, 8, 2>::Zero();  ///< by log width, log height [px]
};

/// Nothing unless all corners lie in front of the camera.
std::optional<PredictedOpening> predictOpening(const geometry::PinholeCamera& camera,
                                               const Eigen::Isometry3d& T_camera_window,
                                               const geometry::OpeningSize& size);

/// `T` moved by (dx, dy, dz, rotation vector): translation added, rotation about fixed axes.
Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Eigen::Matrix<double, 6, 1>& step);

/// Matrix of the cross product: skew(a) * b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

}  // namespace window_ingress::estimation
