#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// A straight line of the image: {p : normal . (p - point) = 0} [px].
struct Line {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();  ///< unit vector
  double sigma_px = 0.0;                              ///< standard deviation across the line, at `point` [px]
  double sigma_rad = 0.0;                             ///< of its direction [rad]

  /// Signed distance of a point [px].
  double distance(const Eigen::Vector2d& p) const { return normal.dot(p - point); }
};

/// A line near an axis: offset from it at a position along it.
struct OffsetLine {
  double offset = 0.0;  ///< at position 0 [px]
  double slope = 0.0;   ///< [px per px]
  double at(double position) const { return offset + slope * position; }
};

inline constexpr int kMostPoints = 128;  ///< of one line

/// Fits the line to points near it: reweighted least squares with Tukey's bisquare. Points further off than
/// three times `scale_px` do not count in the end. With fewer than two points, or more than `kMostPoints`,
/// the line does not change. Allocates nothing.
/// \param positions of the points, in their order along the line \param offsets as many
void fitRobustLine(const std::vector<double>& positions, const std::vector<double>& offsets, double scale_px,
                   OffsetLine& line);

/// A point of the image and its covariance.
struct LineCorner {
  Eigen::Vector2d point;
  Eigen::Matrix2d covariance;  ///< [px^2]
};

/// Intersection of two borders, with its covariance from both. Nothing if they are nearly parallel.
std::optional<LineCorner> meet(const Line& a, const Line& b);

/// The corner in raw pixels. \param lens null: no distortion
LineCorner throughLens(const LineCorner& ideal, const geometry::PinholeCamera* lens);

/// A fitted line between two of its points, converted from the undistorted to the raw image.
Edge edgeThroughLens(const Line& line, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                     const geometry::PinholeCamera* lens);

}  // namespace window_ingress::detection
