#pragma once

#include <Eigen/Core>

namespace window_ingress::detection {

/// Shares of the channels in their sum, BGR; reduced for dark pixels, whose colour is noisy. \param pixel BGR
/// [grey levels]
inline Eigen::Vector3f chromaticity(const Eigen::Vector3f& pixel) {
  constexpr float kDarkness = 30.0F;  ///< [grey levels]
  return pixel / (pixel.sum() + kDarkness);
}

}  // namespace window_ingress::detection
