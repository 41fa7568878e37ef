#pragma once

#include <opencv2/core.hpp>

#include "simulation/scenario/camera_params.hpp"

namespace window_ingress::simulation {

/// Brightness and colour: gain and white balance, fixed or automatic with a lag. The automatic ones follow
/// what the images before this one needed, exponentially in the logarithm of the gains.
class ExposureControl {
 public:
  explicit ExposureControl(const CameraParams& params);

  /// Of blue, green and red, for the image with this stamp, the light's colour included.
  cv::Vec3d gainsAt(double stamp_sec);
  /// What the image looks like before its gains, light's colour not included: mean of blue, green, red.
  void observe(const cv::Vec3d& mean_grey);
  bool automatic() const { return params_.auto_exposure || params_.auto_white_balance; }

  /// Blue, green, red of a black body's light relative to 6500 K, green 1 (Planck's law at 450, 550, 610 nm).
  static cv::Vec3d colourOf(double temperature_k);

 private:
  CameraParams params_;
  cv::Vec3d light_, balance_{1, 1, 1}, wanted_balance_{1, 1, 1};
  double gain_, wanted_gain_, last_sec_ = 0.0;
};

}  // namespace window_ingress::simulation
