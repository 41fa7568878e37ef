#pragma once

#include <Eigen/Core>
#include <array>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One border of the opening as measured in the image.
struct Edge {
  bool visible = false;   ///< false: cut away or not found; then nothing else of it may be used
  double sigma_px = 0.0;  ///< standard deviation of the fitted line across itself, at its middle [px]
  /// Standard deviation of the line's direction [rad].
  double sigma_rad = 0.0;
};

/// The target window in one image: what the detector knows and nothing that it guesses.
struct WindowObservation {
  double stamp_sec = 0.0;  ///< exposure time of the image it was seen in
  /// Inner border of the opening's front, canonical order, in pixels of the image as it came (distorted).
  geometry::Quadrilateral corners;
  /// Covariance of each corner [px^2], from the two edges that meet in it.
  std::array<Eigen::Matrix2d, 4> corner_covariance;
  std::array<Edge, 4> edges;    ///< top, right, bottom, left
  double score = 0.0;           ///< 0 (barely passed the gates) to 1 (certain)
  bool has_appearance = false;  ///< a reference was given and enough pixels could be compared
  double bhattacharyya = 0.0;   ///< 0 identical to 1 disjoint; only if has_appearance
};

}  // namespace window_ingress::detection
