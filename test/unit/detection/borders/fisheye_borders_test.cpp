/// Borders far off the axis of a fisheye, where undistortion stretches the image fourfold or more.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "detection/tracking/edge_tracker.hpp"
#include "drawn_window.hpp"
#include "window_ingress/detection/border_refinement.hpp"

namespace window_ingress::detection::fisheye_borders_test {

using Eigen::Vector2d;
using geometry::Quadrilateral;

/// The part with the opening of an image of 640 x 512 pixels and 150 degrees.
geometry::PinholeCamera fisheye() {
  auto camera = geometry::PinholeCamera::fromFieldOfView(480, 440, 1.0);
  camera.model = geometry::LensModel::kEquidistant;
  camera.fx = camera.fy = 320.0 / 1.309;
  camera.cx = 170.0;
  return camera;
}

/// An undistorted opening. Its right side is 60 degrees off the axis, its left side 35 degrees.
Quadrilateral opening(double shift_px) {
  const geometry::PinholeCamera lens = fisheye();
  Quadrilateral quad = test::turned(test::rectangle(-0.7, -1.1, 1.75, 1.0), 0.05, 0.1);
  for (Vector2d& p : quad) p = lens.fx * p + Vector2d(lens.cx + shift_px, lens.cy);
  return quad;
}

/// 4 x 4 undistorted points in each pixel, pixel by pixel.
const std::vector<Vector2d>& samples() {
  static const std::vector<Vector2d> all = [] {
    const geometry::PinholeCamera lens = fisheye();
    std::vector<Vector2d> points;
    for (int y = 0; y < lens.height; ++y)
      for (int x = 0; x < lens.width; ++x)
        for (int k = 0; k < 16; ++k)
          points.push_back(lens.undistort({x - 0.375 + 0.25 * (k % 4), y - 0.375 + 0.25 * (k / 4)}));
    return points;
  }();
  return all;
}

/// The fisheye's image of the opening.
cv::Mat drawn(const Quadrilateral& ideal, double noise, unsigned seed) {
  cv::Mat image(fisheye().height, fisheye().width, CV_8UC1);
  auto sample = samples().begin();
  for (int i = 0; i < static_cast<int>(image.total()); ++i) {
    int inside = 0;
    for (int k = 0; k < 16; ++k) inside += geometry::contains(ideal, *sample++);
    image.data[i] = cv::saturate_cast<uchar>(170 - 110.0 * inside / 16);
  }
  cv::GaussianBlur(image, image, cv::Size(), 0.7);
  test::addNoise(image, noise, seed);
  return image;
}

/// Distance of a point of the ideal image from a side, in pixels of the distorted image.
double besideSide(const Quadrilateral& ideal, int side, const Vector2d& point) {
  const Vector2d from = ideal[side], span = ideal[(side + 1) % 4] - from;
  const Vector2d foot = from + span * ((point - from).dot(span) / span.squaredNorm());
  return std::copysign((point - foot).norm(), span.x() * (point - foot).y() - span.y() * (point - foot).x()) /
         fisheye().pixelAcross(foot, span);
}

TEST(FisheyeBorders, CornersAreLocatedToATenthOfAPixelOfTheImage) {
  const geometry::PinholeCamera lens = fisheye();
  for (const double shift_px : {0.0, 3.3}) {
    const Quadrilateral ideal = opening(shift_px);
    Quadrilateral truth;
    for (int i = 0; i < 4; ++i) truth[i] = lens.distort(ideal[i]);
    const auto borders = refineBorders(drawn(ideal, 3.0, 7), {test::grown(truth, 1.0), 3.0}, &lens);
    ASSERT_TRUE(borders) << shift_px;
    EXPECT_LT(test::worstCorner(borders->corners, truth), 0.1) << shift_px;
  }
}

// The window grows by as much as between two images at a distance of a third of a metre.
TEST(FisheyeBorders, ABorder60DegreesOffTheAxisIsFollowedAndItsSpreadIsHonest) {
  const geometry::PinholeCamera lens = fisheye();
  const int side = geometry::kRight, trials = 24;
  double squares_px = 0.0, squares = 0.0;  // of errors; of errors over stated sigmas
  for (int i = 0; i < trials; ++i) {
    const Quadrilateral before = opening(0.0), now = opening(18.0 + 0.37 * i);
    const auto stretch = [&](const Quadrilateral& quad) { return Stretch{quad[side], quad[(side + 1) % 4]}; };
    EdgeTracker tracker;
    tracker.learn({drawn(before, 12.0, 100 + i), &lens}, stretch(before), 500.0);
    const auto seen = tracker.follow({drawn(now, 12.0, 200 + i), &lens}, stretch(opening(10.0)), 510.0, 6.0);
    ASSERT_TRUE(seen.fitted) << i;
    const double off_px = besideSide(now, side, seen.line.point);
    squares_px += off_px * off_px / trials;
    const Edge edge = edgeThroughLens(seen.line, seen.a, seen.b, &lens);
    squares += std::pow(off_px / edge.sigma_px, 2) / trials;
  }
  EXPECT_LT(std::sqrt(squares_px), 0.1);
  EXPECT_GT(squares, 0.3);
  EXPECT_LT(squares, 3.0);
}

}  // namespace window_ingress::detection::fisheye_borders_test
