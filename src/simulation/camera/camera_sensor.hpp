#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "simulation/camera/camera_motion.hpp"
#include "simulation/camera/exposure_control.hpp"
#include "simulation/camera/lens.hpp"
#include "simulation/random_stream.hpp"
#include "simulation/rendering/renderer.hpp"
#include "simulation/scenario/camera_params.hpp"
#include "simulation/scene/scene.hpp"

namespace window_ingress::simulation {

/// Noise of a camera: of each channel of each pixel normal and independent, the standard deviation by its
/// grey level sqrt(noise_grey^2 + shot_noise_grey^2 * grey / 255).
class CameraNoise {
 public:
  CameraNoise(const CameraParams& params, const cv::Size& size, std::uint32_t seed);

  /// Depends on seed and index alone.
  void addTo(cv::Mat& image, std::uint64_t index) const;

 private:
  void addByGrey(cv::Mat& image, const cv::Rect& part) const;

  std::uint32_t seed_;
  cv::Mat brighter_, darker_;  // the same for all grey levels: what is added, what is taken away
  cv::Mat unit_;               // by grey level: CV_8SC3, in 1/32
  int deviation_[256] = {};    // in 1/256
};

/// Images by a camera that moves while it takes them: the mean of several over the time in which the
/// shutter is open, row by row as they are read out. The middle row's middle of exposure is the motion's
/// stamp. Few images are drawn when little moves, one when nothing does.
class Shutter {
 public:
  static constexpr int kMaxImages = 6;
  static constexpr int kMaxBands = 24;
  static constexpr double kShiftOfImage_px = 1.5;  ///< between two images
  static constexpr double kShiftOfBand_px = 0.75;  ///< between two bands of rows

  Shutter(double exposure_sec, double readout_sec) : exposure_sec_(exposure_sec), readout_sec_(readout_sec) {}

  void take(Renderer& renderer, const geometry::PinholeCamera& camera, const CameraMotion& motion,
            cv::Mat& image);

 private:
  double exposure_sec_, readout_sec_;
  cv::Mat one_, sum_;
};

/// Makes of ideal renderings what a camera delivers: motion during the exposure, distortion, blur, brightness
/// and colour, noise.
class CameraSensor {
 public:
  /// \throws as `Renderer`, `Lens` and `CameraParams::model`
  CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed);

  /// The image number `index` of the flight; the noise depends on seed and index alone, automatic gains on
  /// the images exposed before. The image is valid until the next call.
  cv::Mat expose(const CameraMotion& motion, std::uint64_t index, double stamp_sec);

 private:
  void takeIdeal(const CameraMotion& motion);

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
  /// Of the next image, exposed at `stamp_sec`; nothing if it is lost. `DelayLine::pushUntil` sees to it
  /// that none overtakes another.
  std::optional<double> arrivalOf(double stamp_sec);

 private:
  double latency_sec_, jitter_sec_, drop_probability_;
  RandomStream jitter_, drops_;
};

}  // namespace window_ingress::simulation
