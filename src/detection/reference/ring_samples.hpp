#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Pixels of the ring round an opening, in two bands: frame and surround. Samples lie on lines parallel to
/// the opening's sides in the window's plane, at most one per pixel along a line.
struct RingSamples {
  static constexpr double kFrameWidth = 0.05;     ///< outer edge of the frame's band [mean sides]
  static constexpr double kSurroundWidth = 0.14;  ///< outer edge of the surround's band [mean sides]
  static constexpr int kBands = 2;
  static constexpr int kAlong = 16, kAcross = 2;  ///< most samples along a side, most lines in a band
  static constexpr int kMax = 4 * kAlong * kAcross;

  struct Band {
    std::array<cv::Vec3b, kMax> pixels;  ///< BGR; the first `count` are filled
    int count = 0;                       ///< samples within the image that are not clipped
    int asked = 0;                       ///< all samples, including those outside the image
    double area_px = 0.0;                ///< of the whole band [px]
  };
  std::array<Band, kBands> bands;
  double darkest = 0.0;  ///< least channel, without the darkest fiftieth of ring and opening [grey levels]
};

/// \param image CV_8UC3, not empty
/// \param opening convex and finite, canonical order
void sampleRing(const cv::Mat& image, const geometry::Quadrilateral& opening, RingSamples& samples);

/// The line round an opening at this distance from its border [mean sides of the opening]. Its corners are
/// not finite where the window's plane is seen edge-on.
geometry::Quadrilateral ringLine(const geometry::Quadrilateral& opening, double distance);

}  // namespace window_ingress::detection
