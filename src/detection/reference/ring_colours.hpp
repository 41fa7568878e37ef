#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Colour of the ring round an opening: per band a histogram of the chromaticities r = R / (R + G + B) and g.
/// Each pixel is shared between the four nearest bins. Brightness, and what is seen through the opening, do
/// not count.
struct RingHistogram {
  static constexpr int kBands = 2;                ///< frame, surround
  static constexpr double kFrameWidth = 0.05;     ///< outer edge of the frame's band [mean sides]
  static constexpr double kSurroundWidth = 0.14;  ///< outer edge of the surround's band [mean sides]
  static constexpr int kBins = 8, kCells = kBins * kBins;

  struct Band {
    std::array<float, kCells> share{};  ///< of the pixels; the sum is 1, or 0 if the band is not visible
    double pixels = 0.0;                ///< distinct image pixels in it; 0: too few to count
  };
  std::array<Band, kBands> bands;
};

/// Mean colours of a ring; haze preserves the direction of their difference.
struct RingMeans {
  Eigen::Vector3f frame = Eigen::Vector3f::Zero(), surround = Eigen::Vector3f::Zero();  ///< BGR
  double sigma = 0.0;    ///< of their difference, from the spread of the pixels [grey levels]
  double darkest = 0.0;  ///< least channel of ring and opening [grey levels]

  /// Direction of chromaticity from the surround to the frame, BGR, length 1, sum 0. Nothing where the frame
  /// has no colour of its own, or the surround's colour.
  std::optional<Eigen::Vector3f> paint() const;
};

/// How a ring looks.
struct RingColours {
  RingHistogram seen;
  RingMeans means;
};

/// Measures a ring without allocation.
/// \param image CV_8UC3; anything else has no colour
/// \param min_pixels a band with fewer is not visible
/// \return nothing if the frame's band is not visible, or the whole image is grey
std::optional<RingColours> ringColours(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                       int min_pixels);

/// Bhattacharyya distance of two rings, sqrt(1 - sum sqrt(p q)): 0 alike, 1 disjoint, bands weighted two to
/// one. The distance of two samples of n and m pixels of the same colours is not 0: their expected sum is
/// less than 1 by sum over bins (1 - p) (1/n + 1/m) / 8. (Second order of the square root about its mean; n
/// of 1 - sum times 8 is Freeman and Tukey's statistic, chi-square in the limit.) This bias is subtracted.
double bhattacharyya(const RingHistogram& a, const RingHistogram& b);

/// The smaller of the plain distance and the distance through haze.
double bhattacharyya(const RingColours& reference, const RingColours& seen);

/// The line round an opening at this distance from its border [mean sides of the opening]. Its corners are
/// not finite where the window's plane is seen edge-on.
geometry::Quadrilateral ringLine(const geometry::Quadrilateral& opening, double distance);

/// Moves the histogram of `from` towards that of `to`: 0 leaves it, 1 replaces it. The means, and bands that
/// are not visible in both, do not change.
RingColours blended(const RingColours& from, const RingColours& to, double part);

}  // namespace window_ingress::detection
