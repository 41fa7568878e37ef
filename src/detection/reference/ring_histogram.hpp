#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Colour of the ring round an opening: for each band a histogram of the chromaticities r = R / (R + G + B)
/// and g, each pixel shared between the four bins round it. What is seen through the opening, and how bright
/// things are, does not count.
struct RingHistogram {
  static constexpr int kBands = 2;  ///< frame, surround
  static constexpr int kBins = 8, kCells = kBins * kBins;

  struct Band {
    std::array<float, kCells>
        share{};          ///< of the band's pixels; their sum is 1, or 0 if the band is not seen
    double pixels = 0.0;  ///< different pixels of the image in it; 0: too few to count
  };
  std::array<Band, kBands> bands;
};

/// Mean colours of a ring, for what haze leaves: differences.
struct RingMeans {
  Eigen::Vector3f frame = Eigen::Vector3f::Zero(), surround = Eigen::Vector3f::Zero();  ///< BGR
  double sigma = 0.0;    ///< of their difference, by the spread of their pixels [grey levels]
  double darkest = 0.0;  ///< least channel of ring and opening [grey levels]

  /// Direction of chromaticity from the surround to the frame, BGR, length 1, sum 0; nothing where the frame
  /// has no colour of its own, or that of the surround.
  std::optional<Eigen::Vector3f> paint() const;
};

/// How a ring looks.
struct RingColours {
  RingHistogram seen;
  RingMeans means;
};

/// Measures a ring; allocates nothing.
/// \param image CV_8UC3; anything else has no colour
/// \param min_pixels a band with fewer is not seen
/// \return nothing if the frame's band is not seen, or the whole image is grey
std::optional<RingColours> ringColours(const cv::Mat& image, const geometry::Quadrilateral& opening,
                                       int min_pixels);

/// Bhattacharyya distance of two rings, sqrt(1 - sum sqrt(p q)): 0 alike, 1 disjoint, bands weighted two to
/// one. Two samples of n and m pixels of the same colours are not at distance 0: the expected sum falls short
/// of 1 by sum over bins (1 - p) (1/n + 1/m) / 8 (second order of the square root about its mean; n of 1 -
/// sum times 8 is Freeman and Tukey's statistic, chi-square in the limit). That much is taken off.
double bhattacharyya(const RingHistogram& a, const RingHistogram& b);

/// The smaller of the distances as seen and through haze.
double bhattacharyya(const RingColours& reference, const RingColours& seen);

/// Moves the histogram of `from` towards that of `to`: 0 leaves it, 1 replaces it. Bands that either has not
/// seen stay as they are, and so do the means.
RingColours blended(const RingColours& from, const RingColours& to, double part);

}  // namespace window_ingress::detection
