/// Cameras for looking at scenes in tests.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "simulation/rendering/renderer.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation::views {

/// T_camera_window of a camera that looks from one point at another, its rows level.
inline Eigen::Isometry3d lookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& at) {
  const Eigen::Vector3d forward = (at - from).normalized();
  const Eigen::Vector3d right = forward.cross(Eigen::Vector3d::UnitZ()).normalized();
  Eigen::Matrix3d axes;
  axes << right, forward.cross(right), forward;
  return geometry::makePose(axes, from).inverse();
}

inline cv::Mat photograph(const Scene& scene, const Eigen::Isometry3d& T_camera_window,
                          double fov_rad = 1.0) {
  cv::Mat image;
  Renderer(scene, geometry::PinholeCamera::fromFieldOfView(320, 240, fov_rad)).render(T_camera_window, image);
  return image;
}

inline double grey(const cv::Mat& image) {
  const cv::Scalar mean = cv::mean(image);
  return (mean[0] + mean[1] + mean[2]) / 3.0;
}

/// Mean grey of the pixels around a point of the world.
inline double greyAt(const Scene& scene, const Eigen::Vector3d& from, const Eigen::Vector3d& point) {
  const cv::Mat image = photograph(scene, lookAt(from, point), 0.3);
  return grey(image(cv::Rect(157, 117, 6, 6)));
}

}  // namespace window_ingress::simulation::views
