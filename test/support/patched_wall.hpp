/// A wall with a different pattern at each place and with an opening, for tests.
#pragma once

#include <random>
#include <vector>

#include "drawn_window.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::test {

/// A wall of coloured patches with a window, in metres from the centre of the opening. Equal seeds give equal
/// walls.
class PatchedWall {
 public:
  static constexpr double kAspect = 1.2;  ///< of the opening: width over height

  explicit PatchedWall(unsigned seed, double frame_m = 0.0, double contrast = 40.0) : frame_m_(frame_m) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> place(-1.1, 1.1), size(0.05, 0.25), colour(-contrast, contrast);
    for (int i = 0; i < 120; ++i) {
      const double x = place(random), y = place(random), w = size(random), h = size(random);
      patches_.push_back(
          {x, y, x + w, y + h, cv::Scalar(150 + colour(random), 155 + colour(random), 165 + colour(random))});
    }
  }

  cv::Mat draw(const Eigen::Isometry3d& T_camera_window, geometry::Quadrilateral* opening,
               cv::Scalar within = cv::Scalar(60, 55, 50),
               const geometry::PinholeCamera& camera = lensless()) const {
    cv::Mat image(480, 640, CV_8UC3, cv::Scalar(150, 155, 165));
    for (const Patch& p : patches_)
      fill(image, camera, T_camera_window, p.left, p.top, p.right, p.bottom, p.colour);
    const double h = 0.5, w = kAspect * h;
    if (frame_m_ > 0.0)
      fill(image, camera, T_camera_window, -w - frame_m_, -h - frame_m_, w + frame_m_, h + frame_m_, paint);
    const geometry::Quadrilateral quad = cornersOf(camera, T_camera_window, -w, -h, w, h);
    if (is_open) fillQuad(image, quad, painted_reveal_m > 0.0 ? 0.85 * paint : within);
    if (is_open && painted_reveal_m > 0.0) {
      cv::Mat front(image.size(), CV_8U, cv::Scalar(0)), back = front.clone();
      fillQuad(front, quad, cv::Scalar(255));
      fillQuad(back, cornersOf(camera, T_camera_window, -w, -h, w, h, painted_reveal_m), cv::Scalar(255));
      image.setTo(within, front & back);
    }
    if (opening) *opening = quad;
    cv::GaussianBlur(image, image, cv::Size(), 0.7);
    return image;
  }

  cv::Scalar paint = cv::Scalar(30, 110, 210);  ///< of the frame
  bool is_open = true;                          ///< false: the wall covers the opening, too
  double painted_reveal_m = 0.0;                ///< depth of a reveal in a darker shade of the frame's paint

  static geometry::PinholeCamera lensless() {
    return geometry::PinholeCamera::fromFieldOfView(640, 480, 1.05);
  }

 private:
  struct Patch {
    double left, top, right, bottom;
    cv::Scalar colour;
  };

  static geometry::Quadrilateral cornersOf(const geometry::PinholeCamera& camera,
                                           const Eigen::Isometry3d& T_camera_window, double left, double top,
                                           double right, double bottom, double depth = 0.0) {
    geometry::Quadrilateral quad;
    const double xs[] = {left, right, right, left}, ys[] = {top, top, bottom, bottom};
    for (int i = 0; i < 4; ++i)
      quad[i] = *camera.project(T_camera_window * Eigen::Vector3d(depth, -xs[i], -ys[i]));
    return quad;
  }
  static void fill(cv::Mat& image, const geometry::PinholeCamera& camera,
                   const Eigen::Isometry3d& T_camera_window, double left, double top, double right,
                   double bottom, const cv::Scalar& colour) {
    fillQuad(image, cornersOf(camera, T_camera_window, left, top, right, bottom), colour);
  }

  double frame_m_;
  std::vector<Patch> patches_;
};

inline Eigen::Isometry3d seenFrom(double distance_m, double yaw_rad, double x_m = 0.0, double y_m = 0.0) {
  return geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(yaw_rad),
                            {x_m, y_m, distance_m});
}

}  // namespace window_ingress::test
