/// A flat wall with painted windows, seen by a moving camera. For tests over several images.
#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <vector>

#include "drawn_window.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::test {

/// The wall is the plane z = 0 of the world, with x to the right and y down. The camera looks along +z from z
/// < 0.
class FlatFacade {
 public:
  static constexpr double kPixelsPerMetre = 200.0;

  /// `count` equal windows side by side, `spacing_m` between their centres, the first at x = 0.
  FlatFacade(int count, double spacing_m, double width_m, double height_m, double frame_m)
      : wall_(static_cast<int>(6 * kPixelsPerMetre),
              static_cast<int>((6.0 + spacing_m * (count - 1)) * kPixelsPerMetre), CV_8UC3,
              cv::Scalar(150, 165, 175)) {
    for (int i = 0; i < count; ++i) {
      const double x = i * spacing_m, w = 0.5 * width_m, h = 0.5 * height_m;
      windows_.push_back({Eigen::Vector2d(x - w, -h), Eigen::Vector2d(x + w, -h), Eigen::Vector2d(x + w, h),
                          Eigen::Vector2d(x - w, h)});
      paint(windows_.back(), frame_m);
    }
    cv::GaussianBlur(wall_, wall_, cv::Size(), 0.8);
  }

  struct Camera {
    Eigen::Vector3d position_m = {0, 0, -4};
    double yaw_rad = 0.0, pitch_rad = 0.0, roll_rad = 0.0;
    Eigen::Matrix3d R_world_camera() const {
      return (Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(pitch_rad, Eigen::Vector3d::UnitX()) *
              Eigen::AngleAxisd(roll_rad, Eigen::Vector3d::UnitZ()))
          .toRotationMatrix();
    }
  };

  cv::Mat see(const Camera& from, const geometry::PinholeCamera& camera, unsigned noise_seed) const {
    const Eigen::Matrix3d H = homography(from, camera) * worldOfPaint();
    cv::Matx33d matrix;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 3; ++c) matrix(r, c) = H(r, c);
    cv::Mat image;
    cv::warpPerspective(wall_, image, matrix, cv::Size(camera.width, camera.height), cv::INTER_LINEAR,
                        cv::BORDER_REPLICATE);
    cv::Mat noise(image.size(), CV_16SC3);
    cv::RNG(noise_seed + 1).fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
    cv::add(image, noise, image, cv::noArray(), CV_8U);
    return image;
  }
  /// Corners of a window in the image; nothing if one lies behind the camera.
  std::optional<geometry::Quadrilateral> corners(int window, const Camera& from,
                                                 const geometry::PinholeCamera& camera) const {
    const Eigen::Matrix3d H = homography(from, camera);
    geometry::Quadrilateral quad;
    for (int i = 0; i < 4; ++i) {
      const Eigen::Vector3d p = H * windows_[window][i].homogeneous();
      if (p.z() <= 0.0) return std::nullopt;
      quad[i] = p.hnormalized();
    }
    return quad;
  }
  int count() const { return static_cast<int>(windows_.size()); }

 private:
  void paint(const geometry::Quadrilateral& window, double frame_m) {
    geometry::Quadrilateral pixels;
    for (int i = 0; i < 4; ++i) pixels[i] = (window[i] + Eigen::Vector2d(3.0, 3.0)) * kPixelsPerMetre;
    fillQuad(wall_, grown(pixels, frame_m * kPixelsPerMetre), cv::Scalar(50, 140, 215));
    fillQuad(wall_, pixels, cv::Scalar(60, 55, 50));
  }
  static Eigen::Matrix3d worldOfPaint() {
    Eigen::Matrix3d map;
    map << 1.0 / kPixelsPerMetre, 0, -3.0, 0, 1.0 / kPixelsPerMetre, -3.0, 0, 0, 1;
    return map;
  }
  // Converts wall coordinates to pixels.
  static Eigen::Matrix3d homography(const Camera& from, const geometry::PinholeCamera& camera) {
    const Eigen::Matrix3d R = from.R_world_camera().transpose();
    Eigen::Matrix3d plane;
    plane << R.col(0), R.col(1), -R * from.position_m;
    return camera.K() * plane;
  }

  cv::Mat wall_;
  std::vector<geometry::Quadrilateral> windows_;
};

}  // namespace window_ingress::test
