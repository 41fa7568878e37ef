/// Images of windows for tests, drawn antialiased by area coverage.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <random>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::test {

/// Fills a convex quadrilateral; each border pixel gets the part of it that is covered, from 8 x 8 samples.
inline void fillQuad(cv::Mat& image, const geometry::Quadrilateral& quad, const cv::Scalar& colour) {
  constexpr int kGrid = 8;
  double x0 = 1e9, y0 = 1e9, x1 = -1e9, y1 = -1e9;
  for (const Eigen::Vector2d& p : quad) {
    x0 = std::min(x0, p.x()), y0 = std::min(y0, p.y());
    x1 = std::max(x1, p.x()), y1 = std::max(y1, p.y());
  }
  const int left = std::max(0, static_cast<int>(std::floor(x0 - 1))),
            top = std::max(0, static_cast<int>(std::floor(y0 - 1)));
  const int right = std::min(image.cols - 1, static_cast<int>(std::ceil(x1 + 1)));
  const int bottom = std::min(image.rows - 1, static_cast<int>(std::ceil(y1 + 1)));
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      int inside = 0;
      const bool deep =
          geometry::contains(quad, {x - 1.0, y - 1.0}) && geometry::contains(quad, {x + 1.0, y - 1.0}) &&
          geometry::contains(quad, {x - 1.0, y + 1.0}) && geometry::contains(quad, {x + 1.0, y + 1.0});
      for (int k = 0; k < kGrid * kGrid && !deep; ++k)
        inside += geometry::contains(
            quad, {x - 0.5 + (k % kGrid + 0.5) / kGrid, y - 0.5 + (k / kGrid + 0.5) / kGrid});
      const double part = deep ? 1.0 : static_cast<double>(inside) / (kGrid * kGrid);
      for (int c = 0; c < image.channels() && part > 0.0; ++c) {
        uchar& value = image.ptr<uchar>(y)[x * image.channels() + c];
        value = cv::saturate_cast<uchar>(value + part * (colour[c] - value));
      }
    }
}

/// Normally distributed noise of the same kind in each channel [grey levels].
inline void addNoise(cv::Mat& image, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, sigma);
  for (int y = 0; y < image.rows; ++y)
    for (int i = 0; i < image.cols * image.channels(); ++i) {
      uchar& value = image.ptr<uchar>(y)[i];
      value = cv::saturate_cast<uchar>(value + normal(random));
    }
}

/// A quadrilateral grown by `distance_px` on every side (shrunk if negative).
inline geometry::Quadrilateral grown(const geometry::Quadrilateral& quad, double distance_px) {
  geometry::Quadrilateral result;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d before = (quad[i] - quad[(i + 3) % 4]).normalized();
    const Eigen::Vector2d after = (quad[(i + 1) % 4] - quad[i]).normalized();
    const double sine = before.x() * after.y() - before.y() * after.x();
    result[i] = quad[i] + (before - after) * (distance_px / sine);
  }
  return result;
}

struct DrawnWindow {
  int width = 640, height = 480;
  int type = CV_8UC3;
  geometry::Quadrilateral opening;
  double frame_px = 0.0;  ///< 0: a bare hole
  cv::Scalar wall = cv::Scalar(150, 165, 175), frame = cv::Scalar(50, 140, 215),
             hole = cv::Scalar(60, 55, 50);
  double noise = 2.0, blur_px = 0.6;
  unsigned seed = 1;

  cv::Mat draw() const {
    cv::Mat image(height, width, type, wall);
    if (frame_px > 0.0) fillQuad(image, grown(opening, frame_px), frame);
    fillQuad(image, opening, hole);
    if (blur_px > 0.0) cv::GaussianBlur(image, image, cv::Size(), blur_px, blur_px, cv::BORDER_REPLICATE);
    addNoise(image, noise, seed);
    return image;
  }
};

/// The same window in a brick wall with pale joints.
inline cv::Mat drawnBricks(const DrawnWindow& window, int brick_px = 32, int course_px = 12) {
  cv::Mat image(window.height, window.width, CV_8UC3, cv::Scalar(60, 75, 140));
  const cv::Scalar joint(150, 155, 160);
  for (int y = 0, row = 0; y < image.rows; y += course_px, ++row) {
    image.rowRange(y, std::min(y + 2, image.rows)).setTo(joint);
    for (int x = row % 2 * brick_px / 2; x < image.cols; x += brick_px)
      cv::rectangle(image, cv::Rect(x, y, 2, course_px), joint, cv::FILLED);
  }
  if (window.frame_px > 0.0) fillQuad(image, grown(window.opening, window.frame_px), window.frame);
  fillQuad(image, window.opening, window.hole);
  if (window.blur_px > 0.0)
    cv::GaussianBlur(image, image, cv::Size(), window.blur_px, window.blur_px, cv::BORDER_REPLICATE);
  addNoise(image, window.noise, window.seed);
  return image;
}

/// An upright rectangle, canonical order.
inline geometry::Quadrilateral rectangle(double left, double top, double right, double bottom) {
  using Eigen::Vector2d;
  return {Vector2d(left, top), Vector2d(right, top), Vector2d(right, bottom), Vector2d(left, bottom)};
}

/// The same rectangle, turned by `angle_rad` about its centre and in perspective: `keystone` shortens the
/// right side.
inline geometry::Quadrilateral turned(geometry::Quadrilateral quad, double angle_rad, double keystone) {
  const Eigen::Vector2d centre = geometry::centroid(quad);
  for (int i = 0; i < 4; ++i) {
    Eigen::Vector2d d = quad[i] - centre;
    if (i == geometry::kTopRight || i == geometry::kBottomRight) d.y() *= 1.0 - keystone;
    quad[i] = centre + Eigen::Rotation2Dd(angle_rad) * d;
  }
  return quad;
}

/// Largest distance between corresponding corners [px].
inline double worstCorner(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b) {
  double worst = 0.0;
  for (int i = 0; i < 4; ++i) worst = std::max(worst, (a[i] - b[i]).norm());
  return worst;
}

}  // namespace window_ingress::test
