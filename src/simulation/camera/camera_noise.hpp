#pragma once

#include <cstdint>
#include <opencv2/core.hpp>

#include "simulation/scenario/camera_params.hpp"

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

}  // namespace window_ingress::simulation
