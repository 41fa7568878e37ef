#include "simulation/camera/lens.hpp"

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <stdexcept>

namespace window_ingress::simulation {
namespace {

constexpr double kInverseTolerance_px = 1e-3;
constexpr int kMargin_px = 2;

// Ideal pixel of each distorted one.
cv::Mat idealPixels(const geometry::PinholeCamera& camera) {
  cv::Mat map(camera.height, camera.width, CV_32FC2);
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u) {
      const Eigen::Vector2d pixel(u, v), ideal = camera.undistort(pixel);
      if (!ideal.allFinite() || (camera.distort(ideal) - pixel).norm() > kInverseTolerance_px)
        throw std::invalid_argument(
            "camera: distortion k1, k2, p1, p2, k3 cannot be undone at the image's border");
      map.at<cv::Vec2f>(v, u) = {static_cast<float>(ideal.x()), static_cast<float>(ideal.y())};
    }
  return map;
}

}  // namespace

Lens::Lens(const geometry::PinholeCamera& camera) : ideal_(camera), size_(camera.width, camera.height) {
  if (!camera.hasDistortion()) return;
  cv::Mat map = idealPixels(camera), channels[2];
  cv::split(map, channels);
  double left, right, top, bottom;
  cv::minMaxLoc(channels[0], &left, &right);
  cv::minMaxLoc(channels[1], &top, &bottom);
  const double x0 = std::floor(left) - kMargin_px, y0 = std::floor(top) - kMargin_px;
  ideal_ = camera.withoutDistortion();
  ideal_.cx -= x0;
  ideal_.cy -= y0;
  ideal_.width = static_cast<int>(std::ceil(right) - x0) + kMargin_px + 1;
  ideal_.height = static_cast<int>(std::ceil(bottom) - y0) + kMargin_px + 1;
  if (ideal_.width > 2 * camera.width || ideal_.height > 2 * camera.height)
    throw std::invalid_argument("camera: distortion k1, k2, p1, p2, k3 is too strong for this field of view");
  map -= cv::Scalar(x0, y0);
  cv::convertMaps(map, cv::noArray(), map_, map_fraction_, CV_16SC2);
}

void Lens::distort(const cv::Mat& ideal_image, cv::Mat& image) const {
  if (map_.empty())
    image = ideal_image;
  else
    cv::remap(ideal_image, image, map_, map_fraction_, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
}

}  // namespace window_ingress::simulation
