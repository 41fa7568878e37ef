#include "detection/candidates/undistortion_map.hpp"

#include <tuple>

namespace window_ingress::detection {
namespace {

// The camera for pixels that are means of factor x factor raw pixels.
geometry::PinholeCamera reduced(geometry::PinholeCamera camera, const cv::Size& level, int factor) {
  const double shift = 0.5 * (factor - 1);
  camera.width = level.width, camera.height = level.height;
  camera.fx /= factor, camera.fy /= factor;
  camera.cx = (camera.cx - shift) / factor, camera.cy = (camera.cy - shift) / factor;
  return camera;
}

auto asTuple(const geometry::PinholeCamera& c) {
  return std::tie(c.model, c.width, c.height, c.fx, c.fy, c.cx, c.cy, c.distortion);
}

}  // namespace

void UndistortionMap::set(const geometry::PinholeCamera* camera, const cv::Size& level, int factor) {
  if (!camera || !camera->hasDistortion()) {
    camera_.reset();
    table_.release();
    return;
  }
  const geometry::PinholeCamera lens = reduced(*camera, level, factor);
  if (camera_ && asTuple(lens) == asTuple(*camera_)) return;
  camera_ = lens;
  table_.create(level, CV_32FC2);
  for (int y = 0; y < level.height; ++y)
    for (int x = 0; x < level.width; ++x) {
      const Eigen::Vector2d ideal = lens.undistort(Eigen::Vector2d(x, y));
      table_.ptr<cv::Vec2f>(y)[x] = cv::Vec2f(static_cast<float>(ideal.x()), static_cast<float>(ideal.y()));
    }
}

}  // namespace window_ingress::detection
