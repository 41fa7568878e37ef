#pragma once

#include <Eigen/Core>

namespace window_ingress::estimation {

/// How a camera moves, odom axes: what a stamp that is off displaces it by.
struct CameraMotion {
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_radps = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::estimation
