#include "simulation/camera/shutter.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::simulation {
namespace {

int countFor(double shifts, int most) { return std::clamp(static_cast<int>(std::ceil(shifts)), 1, most); }

}  // namespace

void Shutter::take(Renderer& renderer, const geometry::PinholeCamera& camera, const CameraMotion& motion,
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

}  // namespace window_ingress::simulation
