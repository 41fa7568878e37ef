#pragma once

#include <Eigen/Geometry>
#include <string>

#include "evaluation/poses/synthetic_approach.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::test {

/// Configuration faults in what a synthetic approach reports.
struct FrameFaults {
  Eigen::Vector3d mounting_rad = Eigen::Vector3d::Zero();  ///< the camera is turned about the body's x, y, z
  std::string mounting_axes = "right";  ///< right; optical: an identity; left, right_side, behind
  std::string twist = "body";           ///< body; world, ned (y and z mirrored)
  bool mirrored_odometry = false;       ///< x and y of the position exchanged

  Eigen::Isometry3d T_base_camera(const evaluation::SyntheticApproach& approach) const {
    Eigen::Isometry3d T = approach.T_base_camera();
    if (mounting_axes == "optical") T.linear().setIdentity();
    if (mounting_axes == "left") T.linear() = geometry::yawRotation(M_PI / 2.0) * T.linear();
    if (mounting_axes == "right_side") T.linear() = geometry::yawRotation(-M_PI / 2.0) * T.linear();
    if (mounting_axes == "behind") T.linear() = geometry::yawRotation(M_PI) * T.linear();
    T.linear() = Eigen::AngleAxisd(-mounting_rad.norm(), mounting_rad.stableNormalized()) * T.linear();
    return T;
  }

  evaluation::SyntheticApproach::Odometry reported(evaluation::SyntheticApproach::Odometry sample) const {
    const Eigen::Matrix3d R = sample.T_odom_base.linear();
    if (twist == "world") sample.velocity_odom_mps = R * sample.velocity_odom_mps;
    if (twist == "ned")
      sample.velocity_odom_mps =
          R * Eigen::Vector3d(1.0, -1.0, -1.0).cwiseProduct(R.transpose() * sample.velocity_odom_mps);
    if (mirrored_odometry)
      std::swap(sample.T_odom_base.translation().x(), sample.T_odom_base.translation().y());
    return sample;
  }
};

}  // namespace window_ingress::test
