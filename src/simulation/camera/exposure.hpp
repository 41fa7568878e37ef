/// How an image is exposed: shutter, gain and white balance.
#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "simulation/camera/camera_motion.hpp"
#include "simulation/rendering/renderer.hpp"
#include "simulation/scenario/sensor_params.hpp"

namespace window_ingress::simulation {

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
            cv::Mat& image) {
    const int images = countFor(motion.greatestShift(camera, exposure_sec_) / kShiftOfImage_px, kMaxImages);
    const int bands = countFor(motion.greatestShift(camera, readout_sec_) / kShiftOfBand_px, kMaxBands);
    for (int k = 0; k < images; ++k) {
      const double in_exposure_sec = ((k + 0.5) / images - 0.5) * exposure_sec_;
      cv::Mat& target = images == 1 ? image : one_;
      for (int band = 0; band < bands; ++band) {
        const cv::Range rows(band * camera.height / bands, (band + 1) * camera.height / bands);
        const double in_readout_sec = (0.5 * (rows.start + rows.end) / camera.height - 0.5) * readout_sec_;
        renderer.renderRows(motion.T_camera_window(in_exposure_sec + in_readout_sec), rows, target);
      }
      if (images == 1) return;
      if (k == 0)
        one_.convertTo(sum_, CV_16U);
      else
        cv::add(sum_, one_, sum_, cv::noArray(), CV_16U);
    }
    sum_.convertTo(image, CV_8U, 1.0 / images);
  }

 private:
  static int countFor(double shifts, int most) {
    return std::clamp(static_cast<int>(std::ceil(shifts)), 1, most);
  }

  double exposure_sec_, readout_sec_;
  cv::Mat one_, sum_;
};

/// Brightness and colour: gain and white balance, fixed or automatic with a lag. The automatic ones follow
/// what the images before this one needed, exponentially in the logarithm of the gains.
class ExposureControl {
 public:
  explicit ExposureControl(const CameraParams& params)
      : params_(params),
        light_(colourOf(params.colour_temperature_k)),
        gain_(params.gain),
        wanted_gain_(params.gain) {}

  /// Of blue, green and red, for the image with this stamp, the light's colour included.
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

  /// What the image looks like before its gains, light's colour not included: mean of blue, green, red.
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
