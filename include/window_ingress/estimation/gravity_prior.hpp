#pragma once

#include <Eigen/Core>

namespace window_ingress::estimation {

/// Direction of "up" in the camera at the exposure: a soft prior that never chooses between the two
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

}  // namespace window_ingress::estimation
