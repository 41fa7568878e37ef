#include "window_ingress/simulation/camera_sensor.hpp"

#include <opencv2/imgproc.hpp>
#include <string>

#include "window_ingress/simulation/random_stream.hpp"

namespace window_ingress::simulation {
namespace {

constexpr int kNoiseMargin_px =
    97;  // the noise is larger than the picture; each picture takes it from elsewhere

}  // namespace

CameraSensor::CameraSensor(const Scene& scene, const CameraParams& params, std::uint32_t seed)
    : params_(params), seed_(seed), lens_(params.model()), renderer_(scene, lens_.idealCamera()) {
  if (params.noise_grey <= 0.0) return;
  cv::Mat noise(params.height_px + kNoiseMargin_px, params.width_px + kNoiseMargin_px, CV_16SC3);
  cv::RNG random(RandomStream(seed, "camera noise").bits());
  random.fill(noise, cv::RNG::NORMAL, 0.0, params.noise_grey);
  noise.convertTo(brighter_, CV_8U);
  noise.convertTo(darker_, CV_8U, -1.0);
}

cv::Mat CameraSensor::expose(const Eigen::Isometry3d& T_camera_window, std::uint64_t index) {
  renderer_.render(T_camera_window, ideal_);
  lens_.distort(ideal_, image_);
  if (params_.blur_px > 0.0) cv::GaussianBlur(image_, image_, cv::Size(), params_.blur_px);
  if (params_.gain != 1.0) image_.convertTo(image_, CV_8U, params_.gain);
  if (params_.noise_grey > 0.0) addNoise(index);
  return image_;
}

void CameraSensor::addNoise(std::uint64_t index) {
  RandomStream random(seed_, "camera noise of picture " + std::to_string(index));
  const int x = random.uniformInt(0, kNoiseMargin_px), y = random.uniformInt(0, kNoiseMargin_px);
  const cv::Rect part(x, y, params_.width_px, params_.height_px);
  cv::add(image_, brighter_(part), image_);
  cv::subtract(image_, darker_(part), image_);
}

}  // namespace window_ingress::simulation
