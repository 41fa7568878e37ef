#pragma once

#include <opencv2/core.hpp>

#include "simulation/camera/camera_motion.hpp"
#include "simulation/rendering/renderer.hpp"

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
            cv::Mat& image);

 private:
  double exposure_sec_, readout_sec_;
  cv::Mat one_, sum_;
};

}  // namespace window_ingress::simulation
