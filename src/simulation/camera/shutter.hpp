#pragma once

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

#include "simulation/camera/camera_truth.hpp"
#include "simulation/rendering/renderer.hpp"

namespace window_ingress::simulation {

/// Images of a moving camera: the mean of several renderings over the exposure time, row by row with the
/// readout. The motion's stamp is the middle of the exposure of the middle row. The number of renderings
/// grows with the motion; a static scene needs one.
class Shutter {
 public:
  static constexpr int kMaxImages = 6;
  static constexpr int kMaxBands = 24;
  static constexpr double kShiftOfImage_px = 1.5;  ///< image motion between two renderings
  static constexpr double kShiftOfBand_px = 0.75;  ///< image motion between two bands of rows

  Shutter(double exposure_sec, double readout_sec) : exposure_sec_(exposure_sec), readout_sec_(readout_sec) {}

  void take(Renderer& renderer, const geometry::PinholeCamera& camera, const CameraTruth& motion,
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

}  // namespace window_ingress::simulation
