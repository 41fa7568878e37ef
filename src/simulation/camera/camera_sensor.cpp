#include "simulation/camera/camera_sensor.hpp"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace window_ingress::simulation {
namespace {

constexpr int kMeanStep_px = 8;
constexpr int kMaxImages = 6, kMaxBands = 24;
constexpr double kShiftOfImage_px = 1.5;  // image motion between two renderings
constexpr double kShiftOfBand_px = 0.75;  // image motion between two bands of rows

int countFor(double shifts, int most) { return std::clamp(static_cast<int>(std::ceil(shifts)), 1, most); }

Antialiasing antialiasingOf(const CameraParams& params) {
  return params.antialiasing == "multisampling" ? Antialiasing::kMultisampling : Antialiasing::kEdges;
}

cv::Vec3d meanOf(const cv::Mat& image) {
  cv::Vec3d sum;
  int count = 0;
  for (int v = kMeanStep_px / 2; v < image.rows; v += kMeanStep_px)
    for (int u = kMeanStep_px / 2; u < image.cols; u += kMeanStep_px, ++count)
      sum += image.at<cv::Vec3b>(v, u);
  return sum / std::max(count, 1);
}

void applyGains(const cv::Vec3d& gains, cv::Mat& image) {
  if (gains == cv::Vec3d(1, 1, 1)) return;
  cv::Mat table(1, 256, CV_8UC3);
  for (int grey = 0; grey < 256; ++grey)
    for (int c = 0; c < 3; ++c)
      table.at<cv::Vec3b>(grey)[c] = cv::saturate_cast<unsigned char>(gains[c] * grey);
  cv::LUT(image, table, image);
}

}  // namespace

CameraSensor::CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed)
    : exposure_sec_(params.exposure_sec),
      readout_sec_(params.readout_sec),
      blur_px_(params.blur_px),
      lens_(params.model()),
      control_(params),
      noise_(params, lens_.size(), seed) {
  if (lens_.planes().size() > 1 && params.readout_sec > 0.0)
    throw std::invalid_argument("camera/readout_sec: must be 0 with a lens that needs several planes");
  for (const IdealPlane& plane : lens_.planes())
    renderers_.push_back(std::make_unique<Renderer>(scene, plane.camera, antialiasingOf(params)));
}

void CameraSensor::take(Renderer& renderer, const geometry::PinholeCamera& camera, const CameraTruth& motion,
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

void CameraSensor::takeIdeal(const CameraTruth& motion) {
  const auto& planes = lens_.planes();
  if (planes.size() == 1) return take(*renderers_[0], planes[0].camera, motion, ideal_);
  ideal_.create(lens_.idealSize(), CV_8UC3);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    take(*renderers_[i], planes[i].camera, motion.turned(planes[i].R_plane_camera), face_);
    face_.copyTo(ideal_(planes[i].part));
  }
}

cv::Mat CameraSensor::expose(const CameraTruth& motion, std::uint64_t index, double stamp_sec) {
  takeIdeal(motion);
  lens_.distort(ideal_, image_);
  if (blur_px_ > 0.0) cv::GaussianBlur(image_, image_, cv::Size(), blur_px_);
  const cv::Vec3d gains = control_.gainsAt(stamp_sec);
  if (control_.automatic()) control_.observe(meanOf(image_));
  applyGains(gains, image_);
  noise_.addTo(image_, index);
  return image_;
}

std::optional<double> CameraTransport::arrivalOf(double stamp_sec) {
  const double arrival_sec =
      stamp_sec + params_.latency_sec + jitter_.uniform(0.0, 1.0) * params_.latency_jitter_sec;
  if (drops_.uniform(0.0, 1.0) < params_.drop_probability) return std::nullopt;
  return arrival_sec;
}

}  // namespace window_ingress::simulation
