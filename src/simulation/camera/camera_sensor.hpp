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

/// Turns ideal renderings into a camera's images: motion during the exposure, distortion, blur, brightness,
/// colour and noise.
class CameraSensor {
 public:
  /// \throws as `Renderer`, `Lens` and `CameraParams::model`
  CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed);

  /// The image number `index` of the flight. Noise depends on the seed and the index only, automatic gains on
  /// earlier exposures. The image is valid until the next call.
  cv::Mat expose(const CameraTruth& motion, std::uint64_t index, double stamp_sec);

 private:
  void takeIdeal(const CameraTruth& motion);

  double blur_px_;
  Lens lens_;
  std::vector<std::unique_ptr<Renderer>> renderers_;  ///< one per plane of the lens
  Shutter shutter_;
  ExposureControl control_;
  CameraNoise noise_;
  cv::Mat ideal_, face_, image_;
};

/// Delivery of images: arrival times and losses.
class CameraTransport {
 public:
  CameraTransport(const CameraParams& params, std::uint32_t seed);
  /// Arrival time of the next image, exposed at `stamp_sec`; empty if the image is lost. `DelayLine::push`
  /// keeps the order.
  std::optional<double> arrivalOf(double stamp_sec);

 private:
  double latency_sec_, jitter_sec_, drop_probability_;
  RandomStream jitter_, drops_;
};

}  // namespace window_ingress::simulation
