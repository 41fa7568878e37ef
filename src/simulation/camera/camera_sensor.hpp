#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <string>
#include <vector>

#include "simulation/camera/camera_truth.hpp"
#include "simulation/camera/lens.hpp"
#include "simulation/random_stream.hpp"
#include "simulation/rendering/renderer.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/scene/scene.hpp"

namespace window_ingress::simulation {

/// Brightness and colour: gain and white balance, fixed or automatic. The automatic ones follow the demand of
/// earlier images with a lag, exponentially in the logarithm of the gains.
class ExposureControl {
 public:
  explicit ExposureControl(const CameraParams& params)
      : params_(params),
        light_(colourOf(params.colour_temperature_k)),
        gain_(params.gain),
        wanted_gain_(params.gain) {}

  /// Gains of blue, green and red for the image with this stamp, including the light's colour.
  cv::Vec3d gainsAt(double stamp_sec) {
    const double part = 1.0 - std::exp(-std::max(0.0, stamp_sec - last_sec_) / params_.auto_exposure_sec);
    last_sec_ = stamp_sec;
    gain_ = nearer(gain_, wanted_gain_, part);
    for (int c = 0; c < 3; ++c) balance_[c] = nearer(balance_[c], wanted_balance_[c], part);
    return (gain_ * balance_).mul(light_);
  }

  /// Mean of blue, green and red before the gains, without the light's colour.
  void observe(const cv::Vec3d& mean_grey) {
    const cv::Vec3d mean = mean_grey.mul(light_);
    if (std::min({mean[0], mean[1], mean[2]}) <= 0.0) return;
    if (params_.auto_white_balance)
      for (int c = 0; c < 3; ++c)
        wanted_balance_[c] = std::clamp(mean[1] / mean[c], 1.0 / kGreatestBalance, kGreatestBalance);
    const double grey = mean.dot(wanted_balance_) / 3.0;
    if (params_.auto_exposure)
      wanted_gain_ =
          std::max(params_.least_gain, std::min(params_.target_grey / grey, params_.greatest_gain));
  }

  bool automatic() const { return params_.auto_exposure || params_.auto_white_balance; }

  /// Blue, green, red of a black body's light relative to 6500 K, green 1 (Planck's law at 450, 550, 610 nm).
  static cv::Vec3d colourOf(double temperature_k) {
    const cv::Vec3d wavelengths_um(0.45, 0.55, 0.61);
    cv::Vec3d colour;
    for (int c = 0; c < 3; ++c)
      colour[c] = radiance(wavelengths_um[c], temperature_k) / radiance(wavelengths_um[c], kNeutral_k);
    return colour / colour[1];
  }

 private:
  // Planck's law up to a factor: h c / k = 14388 um K.
  static double radiance(double wavelength_um, double temperature_k) {
    return 1.0 / (std::exp(14388.0 / (wavelength_um * temperature_k)) - 1.0);
  }

  static double nearer(double value, double goal, double part) {
    return value * std::pow(goal / value, part);
  }

  static constexpr double kNeutral_k = 6500.0;
  static constexpr double kGreatestBalance = 4.0;

  CameraParams params_;
  cv::Vec3d light_, balance_{1, 1, 1}, wanted_balance_{1, 1, 1};
  double gain_, wanted_gain_, last_sec_ = 0.0;
};

/// Noise of a camera: normal, independent for each channel of each pixel. The standard deviation depends on
/// the grey level: sqrt(noise_grey^2 + shot_noise_grey^2 * grey / 255).
class CameraNoise {
 public:
  CameraNoise(const CameraParams& params, const cv::Size& size, std::uint32_t seed) : seed_(seed) {
    const bool by_grey = params.shot_noise_grey > 0.0;
    if (!by_grey && params.noise_grey <= 0.0) return;
    cv::Mat noise(size.height + kNoiseMargin_px, size.width + kNoiseMargin_px, CV_16SC3);
    cv::RNG random(RandomStream(seed, "camera noise").bits());
    random.fill(noise, cv::RNG::NORMAL, 0.0, by_grey ? kUnit : params.noise_grey);
    if (!by_grey) {
      noise.convertTo(brighter_, CV_8U);
      noise.convertTo(darker_, CV_8U, -1.0);
      return;
    }
    noise.convertTo(unit_, CV_8S);
    for (int grey = 0; grey < 256; ++grey) {
      const double shot = params.shot_noise_grey * params.shot_noise_grey * grey / 255.0;
      deviation_[grey] =
          static_cast<int>(std::lround(kScale * std::sqrt(params.noise_grey * params.noise_grey + shot)));
    }
  }

  /// The noise depends on the seed and the index only.
  void addTo(cv::Mat& image, std::uint64_t index) const {
    if (brighter_.empty() && unit_.empty()) return;
    RandomStream random(seed_, "camera noise of picture " + std::to_string(index));
    const int x = random.uniformInt(0, kNoiseMargin_px), y = random.uniformInt(0, kNoiseMargin_px);
    const cv::Rect part(x, y, image.cols, image.rows);
    if (!unit_.empty()) return addByGrey(image, part);
    cv::add(image, brighter_(part), image);
    cv::subtract(image, darker_(part), image);
  }

 private:
  // The noise pattern is larger than the image; each image uses another part of it.
  static constexpr int kNoiseMargin_px = 97;
  static constexpr int kUnit = 32, kScale = 256;

  void addByGrey(cv::Mat& image, const cv::Rect& part) const {
    for (int v = 0; v < image.rows; ++v) {
      auto* pixel = image.ptr<std::uint8_t>(v);
      const auto* unit = unit_.ptr<std::int8_t>(part.y + v) + 3 * part.x;
      for (int i = 0; i < 3 * image.cols; ++i) {
        const int noise = (unit[i] * deviation_[pixel[i]] + kUnit * kScale / 2) >> 13;
        pixel[i] = static_cast<std::uint8_t>(std::clamp(pixel[i] + noise, 0, 255));
      }
    }
  }

  std::uint32_t seed_;
  cv::Mat brighter_, darker_;  // noise if equal for all grey levels: to add, to subtract
  cv::Mat unit_;               // pattern for noise by grey level: CV_8SC3, in 1/32
  int deviation_[256] = {};    // by grey level, in 1/256
};

/// Turns ideal renderings into a camera's images: motion during the exposure, distortion, blur, brightness,
/// colour and noise.
///
/// The image of a moving camera is the mean of several renderings over the exposure time, row by row with the
/// readout. The motion's stamp is the middle of the exposure of the middle row. The number of renderings
/// grows with the motion; a static scene needs one.
class CameraSensor {
 public:
  /// \throws as `Renderer`, `Lens` and `CameraParams::model`
  CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed);

  /// The image number `index` of the flight. Noise depends on the seed and the index only, automatic gains on
  /// earlier exposures. The image is valid until the next call.
  cv::Mat expose(const CameraTruth& motion, std::uint64_t index, double stamp_sec);

 private:
  void takeIdeal(const CameraTruth& motion);
  void take(Renderer& renderer, const geometry::PinholeCamera& camera, const CameraTruth& motion,
            cv::Mat& image);

  double exposure_sec_, readout_sec_, blur_px_;
  Lens lens_;
  std::vector<std::unique_ptr<Renderer>> renderers_;  ///< one per plane of the lens
  ExposureControl control_;
  CameraNoise noise_;
  cv::Mat ideal_, face_, image_, one_, sum_;
};

/// Delivery of images: arrival times and losses.
class CameraTransport {
 public:
  CameraTransport(const CameraParams& params, std::uint32_t seed)
      : params_(params), jitter_(seed, "camera latency jitter"), drops_(seed, "camera drops") {}
  /// Arrival time of the next image, exposed at `stamp_sec`; empty if the image is lost. `DelayLine::push`
  /// keeps the order.
  std::optional<double> arrivalOf(double stamp_sec);

 private:
  CameraParams params_;
  RandomStream jitter_, drops_;
};

}  // namespace window_ingress::simulation
