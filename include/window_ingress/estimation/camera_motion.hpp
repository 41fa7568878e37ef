#pragma once

#include <Eigen/Core>

namespace window_ingress::estimation {

/// Motion of a camera in odom axes; a wrong stamp displaces the camera along it.
struct CameraMotion {
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_radps = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::estimation
