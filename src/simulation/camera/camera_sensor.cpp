#include "simulation/camera/camera_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <string>

#include "simulation/random_stream.hpp"

namespace window_ingress::simulation {
namespace {

// The noise is larger than the image; each image takes it from elsewhere.
constexpr int kNoiseMargin_px = 97;
constexpr int kUnit = 32, kScale = 256;

int countFor(double shifts, int most) { return std::clamp(static_cast<int>(std::ceil(shifts)), 1, most); }

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

CameraNoise::CameraNoise(const CameraParams& params, const cv::Size& size, std::uint32_t seed) : seed_(seed) {
  const bool by_grey = params.shot_noise_grey > 0.0;
  if (!by_grey && params.noise_grey <= 0.0) return;
  cv::Mat noise(size.height + kNoiseMargin_px, size.width + kNoiseMargin_px, CV_16SC3);
  cv::RNG random(RandomStream(seed, "camera noise").bits());
  random.fill(noise, cv::RNG::NORMAL, 0.0, by_grey ? kUnit : params.noise_grey);
  if (!by_grey) {
    noise.convertTo(brighter_, CV_8U);
    noise.convertTo(darker_, CV_8U, -1.0);
    return;
  }
  noise.convertTo(unit_, CV_8S);
  for (int grey = 0; grey < 256; ++grey) {
    const double shot = params.shot_noise_grey * params.shot_noise_grey * grey / 255.0;
    deviation_[grey] =
        static_cast<int>(std::lround(kScale * std::sqrt(params.noise_grey * params.noise_grey + shot)));
  }
}

void CameraNoise::addTo(cv::Mat& image, std::uint64_t index) const {
  if (brighter_.empty() && unit_.empty()) return;
  RandomStream random(seed_, "camera noise of picture " + std::to_string(index));
  const int x = random.uniformInt(0, kNoiseMargin_px), y = random.uniformInt(0, kNoiseMargin_px);
  const cv::Rect part(x, y, image.cols, image.rows);
  if (!unit_.empty()) return addByGrey(image, part);
  cv::add(image, brighter_(part), image);
  cv::subtract(image, darker_(part), image);
}

void CameraNoise::addByGrey(cv::Mat& image, const cv::Rect& part) const {
  for (int v = 0; v < image.rows; ++v) {
    auto* pixel = image.ptr<std::uint8_t>(v);
    const auto* unit = unit_.ptr<std::int8_t>(part.y + v) + 3 * part.x;
    for (int i = 0; i < 3 * image.cols; ++i) {
      const int noise = (unit[i] * deviation_[pixel[i]] + kUnit * kScale / 2) >> 13;
      pixel[i] = static_cast<std::uint8_t>(std::clamp(pixel[i] + noise, 0, 255));
    }
  }
}

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

void CameraSensor::takeIdeal(const CameraMotion& motion) {
  const auto& planes = lens_.planes();
  if (planes.size() == 1) return shutter_.take(*renderers_[0], planes[0].camera, motion, ideal_);
  ideal_.create(lens_.idealSize(), CV_8UC3);
  for (std::size_t i = 0; i < planes.size(); ++i) {
    shutter_.take(*renderers_[i], planes[i].camera, motion.turned(planes[i].R_plane_camera), face_);
    face_.copyTo(ideal_(planes[i].part));
  }
}

cv::Mat CameraSensor::expose(const CameraMotion& motion, std::uint64_t index, double stamp_sec) {
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
