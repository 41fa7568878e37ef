#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/core.hpp>
#include <string>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/sensor_params.hpp"

namespace window_ingress::simulation {

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

}  // namespace window_ingress::simulation
