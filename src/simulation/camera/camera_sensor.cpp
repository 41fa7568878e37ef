#include "simulation/camera/camera_sensor.hpp"

#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace window_ingress::simulation {
namespace {

constexpr int kMeanStep_px = 8;

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
    : blur_px_(params.blur_px),
      lens_(params.model()),
      shutter_(params.exposure_sec, params.readout_sec),
      control_(params),
      noise_(params, lens_.size(), seed) {
  if (lens_.planes().size() > 1 && params.readout_sec > 0.0)
    throw std::invalid_argument("camera/readout_sec: must be 0 with a lens that needs several planes");
  for (const IdealPlane& plane : lens_.planes())
    renderers_.push_back(std::make_unique<Renderer>(scene, plane.camera, antialiasingOf(params)));
}

void CameraSensor::takeIdeal(const CameraTruth& motion) {
  const auto& planes = lens_.planes();
  if (planes.size() == 1) return shutter_.take(*renderers_[0], planes[0].camera, motion, ideal_);
  ideal_.create(lens_.idealSize(), CV_8UC3);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    shutter_.take(*renderers_[i], planes[i].camera, motion.turned(planes[i].R_plane_camera), face_);
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

CameraTransport::CameraTransport(const CameraParams& params, std::uint32_t seed)
    : latency_sec_(params.latency_sec),
      jitter_sec_(params.latency_jitter_sec),
      drop_probability_(params.drop_probability),
      jitter_(seed, "camera latency jitter"),
      drops_(seed, "camera drops") {}

std::optional<double> CameraTransport::arrivalOf(double stamp_sec) {
  const double arrival_sec = stamp_sec + latency_sec_ + jitter_.uniform(0.0, 1.0) * jitter_sec_;
  if (drops_.uniform(0.0, 1.0) < drop_probability_) return std::nullopt;
  return arrival_sec;
}

}  // namespace window_ingress::simulation
