/// A drawn window with a frame in a brick wall: the hard case for edge tracking.
#pragma once

#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "frame_set.hpp"

namespace window_ingress::bench {

/// In metres on the wall: axes right and down, origin at the centre of the opening.
struct BrickWall {
  double opening_m = 1.0;  ///< square
  double frame_m = 0.05;
  double brick_m = 0.24, course_m = 0.075, joint_m = 0.010;
};

/// The camera faces the wall. The image is drawn four times as large and averaged down.
inline cv::Mat drawBrickWall(const BrickWall& wall, const geometry::PinholeCamera& camera,
                             const cv::Point3d& position_m, unsigned seed) {
  constexpr int kFine = 4;
  const double scale = kFine * camera.fx / position_m.z;  // fine pixels a metre
  const auto x = [&](double m) {
    return static_cast<int>(std::lround((m - position_m.x) * scale + kFine * (camera.cx + 0.5)));
  };
  const auto y = [&](double m) {
    return static_cast<int>(std::lround((m - position_m.y) * scale + kFine * (camera.cy + 0.5)));
  };
  const auto fill = [&](cv::Mat& image, double left, double top, double right, double bottom,
                        const cv::Scalar& colour) {
    cv::rectangle(image, cv::Point(x(left), y(top)), cv::Point(x(right) - 1, y(bottom) - 1), colour,
                  cv::FILLED);
  };
  cv::Mat fine(kFine * camera.height, kFine * camera.width, CV_8UC3, cv::Scalar(165, 170, 175));
  cv::RNG clay(1);  // the wall is equal in all images
  for (int row = -100; row < 100; ++row)
    for (int column = -40; column < 40; ++column) {
      const double left = (column + (row % 2 ? 0.5 : 0.0)) * wall.brick_m, top = row * wall.course_m;
      const double shade = clay.gaussian(14.0);
      fill(fine, left, top, left + wall.brick_m - wall.joint_m, top + wall.course_m - wall.joint_m,
           cv::Scalar(60 + shade, 75 + shade, 140 + shade));
    }
  const double half = wall.opening_m / 2, outer = half + wall.frame_m;
  fill(fine, -outer, -outer, outer, outer, cv::Scalar(50, 140, 215));
  fill(fine, -half, -half, half, half, cv::Scalar(60, 55, 50));
  cv::Mat image, noise(camera.height, camera.width, CV_16SC3);
  cv::resize(fine, image, cv::Size(camera.width, camera.height), 0, 0, cv::INTER_AREA);
  cv::GaussianBlur(image, image, cv::Size(), 0.6);
  cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0.0, 2.0);
  cv::add(image, noise, image, cv::noArray(), CV_8U);
  return image;
}

/// The camera drifts a few pixels from image to image, 4 m before a window 1 m wide; f = 554 px.
inline Sequence brickWallSequence(int images) {
  Sequence sequence;
  sequence.name = "brick_wall", sequence.kind = "drawn";
  sequence.camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.0472);
  const BrickWall wall;
  for (int i = 0; i < images; ++i)
    sequence.images.push_back(drawBrickWall(
        wall, *sequence.camera, cv::Point3d(0.3 + 0.010 * i, -0.2 + 0.006 * i, 4.0 - 0.017 * i), 1 + i));
  geometry::PinholeCamera near = *sequence.camera;
  const cv::Mat image = drawBrickWall(wall, near, cv::Point3d(0, 0, 2.0), 100);
  const double half = near.fx * wall.opening_m / 2 / 2.0;
  using Eigen::Vector2d;
  const Vector2d centre(near.cx, near.cy);
  sequence.reference.emplace(
      image, geometry::Quadrilateral{centre + Vector2d(-half, -half), centre + Vector2d(half, -half),
                                     centre + Vector2d(half, half), centre + Vector2d(-half, half)});
  return sequence;
}

}  // namespace window_ingress::bench
