#pragma once

#include <Eigen/Core>

namespace window_ingress::detection {

/// Parts of the channels in their sum, BGR; of dark pixels, which know little of it, less. \param pixel BGR
/// [grey levels]
inline Eigen::Vector3f chromaticity(const Eigen::Vector3f& pixel) {
  constexpr float kDarkness = 30.0F;  ///< [grey levels]
  return pixel / (pixel.sum() + kDarkness);
}

}  // namespace window_ingress::detection
