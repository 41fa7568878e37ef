#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Lens distortion on the search level: straight borders are straight lines in the undistorted level only.
/// Points are undistorted, never the image. Without a camera or distortion, nothing changes.
class UndistortionMap {
 public:
  /// Prepares for images of this camera, reduced by this factor. Expensive only when camera or factor change.
  void set(const geometry::PinholeCamera* camera, const cv::Size& level, int factor);

  Eigen::Vector2d undistort(int x, int y) const {
    if (table_.empty()) return {x, y};
    const cv::Vec2f& p = table_.ptr<cv::Vec2f>(y)[x];
    return {p[0], p[1]};
  }
  Eigen::Vector2d undistort(const Eigen::Vector2d& level_px) const {
    return camera_ ? camera_->undistort(level_px) : level_px;
  }
  Eigen::Vector2d distort(const Eigen::Vector2d& ideal_level_px) const {
    return camera_ ? camera_->distort(ideal_level_px) : ideal_level_px;
  }

 private:
  std::optional<geometry::PinholeCamera> camera_;  ///< camera of the level; nothing without distortion
  cv::Mat table_;                                  ///< CV_32FC2, undistorted pixel of every pixel
};

}  // namespace window_ingress::detection
