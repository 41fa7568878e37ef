#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Pixels of the ring round an opening, in two bands, its frame and the surround, on lines parallel to its
/// sides in the plane of the window; at most one sample a pixel along a line.
struct RingSamples {
  static constexpr double kFrameWidth = 0.05;     ///< outer edge of the frame's band [mean sides]
  static constexpr double kSurroundWidth = 0.14;  ///< outer edge of the surround's band [mean sides]
  static constexpr int kBands = 2;
  static constexpr int kAlong = 16, kAcross = 2;  ///< most samples along a side, most lines in a band
  static constexpr int kMax = 4 * kAlong * kAcross;

  struct Band {
    std::array<cv::Vec3b, kMax> pixels;  ///< BGR; the first `count` are filled
    int count = 0;                       ///< samples within the image that are not clipped
    int asked = 0;                       ///< samples, also those outside the image
    double area_px = 0.0;                ///< of the whole band [px]
  };
  std::array<Band, kBands> bands;
  double darkest = 0.0;  ///< least channel, a fiftieth of ring and opening left out [grey levels]
};

/// \param image CV_8UC3, not empty
/// \param opening convex and finite, canonical order
void sampleRing(const cv::Mat& image, const geometry::Quadrilateral& opening, RingSamples& samples);

/// The line round an opening at this distance from its border, in mean sides of the opening; corners are not
/// finite where the plane of the window is seen edge-on.
geometry::Quadrilateral ringLine(const geometry::Quadrilateral& opening, double distance);

}  // namespace window_ingress::detection
