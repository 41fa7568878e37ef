#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/simulation/lens.hpp"
#include "window_ingress/simulation/renderer.hpp"
#include "window_ingress/simulation/camera_params.hpp"

namespace window_ingress::simulation {

/// Makes of an ideal rendering what a camera delivers: distortion, blur, exposure, noise.
class CameraSensor {
 public:
  /// \throws as `Renderer` and `Lens`
  CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed);

  /// The picture number `index` of the flight; the noise depends on seed and index alone. The picture is
  /// valid until the next call.
  cv::Mat expose(const Eigen::Isometry3d& T_camera_window, std::uint64_t index);

 private:
  void addNoise(std::uint64_t index);

  CameraParams params_;
  std::uint32_t seed_;
  Lens lens_;
  Renderer renderer_;
  cv::Mat ideal_, image_, brighter_, darker_;  // noise: what is added, what is taken away
};

}  // namespace window_ingress::simulation
