#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "simulation/camera/camera_noise.hpp"
#include "simulation/camera/camera_truth.hpp"
#include "simulation/camera/exposure_control.hpp"
#include "simulation/camera/lens.hpp"
#include "simulation/camera/shutter.hpp"
#include "simulation/random_stream.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/scene/scene.hpp"

namespace window_ingress::simulation {

/// Makes of ideal renderings what a camera delivers: motion during the exposure, distortion, blur, brightness
/// and colour, noise.
class CameraSensor {
 public:
  /// \throws as `Renderer`, `Lens` and `CameraParams::model`
  CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed);

  /// The image number `index` of the flight; the noise depends on seed and index alone, automatic gains on
  /// the images exposed before. The image is valid until the next call.
  cv::Mat expose(const CameraTruth& motion, std::uint64_t index, double stamp_sec);

 private:
  void takeIdeal(const CameraTruth& motion);

  double blur_px_;
  Lens lens_;
  std::vector<std::unique_ptr<Renderer>> renderers_;  ///< one a plane of the lens
  Shutter shutter_;
  ExposureControl control_;
  CameraNoise noise_;
  cv::Mat ideal_, face_, image_;
};

/// When images arrive, and which ones do not.
class CameraTransport {
 public:
  CameraTransport(const CameraParams& params, std::uint32_t seed);
  /// Of the next image, exposed at `stamp_sec`; nothing if it is lost. `DelayLine::push` sees to it
  /// that none overtakes another.
  std::optional<double> arrivalOf(double stamp_sec);

 private:
  double latency_sec_, jitter_sec_, drop_probability_;
  RandomStream jitter_, drops_;
};

}  // namespace window_ingress::simulation
