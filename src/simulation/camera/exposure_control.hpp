#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "simulation/scenario/sensor_params.hpp"

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
    cv::Vec3d gains;
    for (int c = 0; c < 3; ++c) {
      balance_[c] = nearer(balance_[c], wanted_balance_[c], part);
      gains[c] = gain_ * balance_[c] * light_[c];
    }
    return gains;
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

}  // namespace window_ingress::simulation
