#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// How badly four corners fit any view of a rectangle of a known aspect [standard deviations]: the square
/// root of what is left of the squared, weighted distances of the corners when pose and aspect are fitted.
/// Chi with two degrees of freedom, where the corners are what they are said to be: size and distance do not
/// show, the six numbers of a pose do, eight coordinates are seen.
struct RectangleMisfit {
  double aspect = 1.0;            ///< width over height
  double log_aspect_sigma = 0.0;  ///< of its logarithm; above 0
  double least_px = 0.3;          ///< at least this standard deviation of each coordinate [px]

  /// \param ideal pixels of the undistorted picture, canonical order
  /// \param covariance of each corner [px^2]
  /// \return nothing for what is not convex or not finite
  std::optional<double> of(const geometry::Quadrilateral& ideal,
                           const std::array<Eigen::Matrix2d, 4>& covariance,
                           const geometry::PinholeCamera& camera) const;
};

}  // namespace window_ingress::detection
