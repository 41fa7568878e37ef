#include "simulation/camera/camera_sensor.hpp"

#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <vector>

#include "simulation/camera/camera_noise.hpp"
#include "simulation/camera/exposure_control.hpp"
#include "simulation/camera/lens.hpp"
#include "simulation/scene/shutter.hpp"

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

struct CameraSensor::Impl {
  Impl(const Scene& scene, const CameraParams& given, std::uint32_t seed)
      : params(given),
        lens(given.model()),
        shutter(given.exposure_sec, given.readout_sec),
        control(given),
        noise(given, lens.size(), seed) {
    if (lens.planes().size() > 1 && given.readout_sec > 0.0)
      throw std::invalid_argument("camera/readout_sec: must be 0 with a lens that needs several planes");
    for (const IdealPlane& plane : lens.planes())
      renderers.push_back(std::make_unique<Renderer>(scene, plane.camera, antialiasingOf(given)));
  }

  void takeIdeal(const CameraMotion& motion) {
    const auto& planes = lens.planes();
    if (planes.size() == 1) {
      shutter.take(*renderers[0], planes[0].camera, motion, ideal);
      return;
    }
    ideal.create(lens.idealSize(), CV_8UC3);
    for (std::size_t i = 0; i < planes.size(); ++i) {
      shutter.take(*renderers[i], planes[i].camera, motion.turned(planes[i].R_plane_camera), face);
      face.copyTo(ideal(planes[i].part));
    }
  }

  CameraParams params;
  Lens lens;
  std::vector<std::unique_ptr<Renderer>> renderers;  // one a plane of the lens
  Shutter shutter;
  ExposureControl control;
  CameraNoise noise;
  cv::Mat ideal, face, image;
};

CameraSensor::CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed)
    : impl_(std::make_unique<Impl>(scene, params, seed)) {}

CameraSensor::~CameraSensor() = default;

cv::Mat CameraSensor::expose(const CameraMotion& motion, std::uint64_t index, double stamp_sec) {
  Impl& own = *impl_;
  own.takeIdeal(motion);
  own.lens.distort(own.ideal, own.image);
  if (own.params.blur_px > 0.0) cv::GaussianBlur(own.image, own.image, cv::Size(), own.params.blur_px);
  const cv::Vec3d gains = own.control.gainsAt(stamp_sec);
  if (own.control.automatic()) own.control.observe(meanOf(own.image));
  applyGains(gains, own.image);
  own.noise.addTo(own.image, index);
  return own.image;
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
