#pragma once

#include <Eigen/Core>
#include <optional>

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
  double slope = 0.0;   ///< [px a px]
  double at(double position) const { return offset + slope * position; }
};

/// Points near an axis, in the caller's memory.
struct OffsetPoints {
  const double* positions;
  const double* offsets;
  double* scratch;  ///< room for two numbers a point
  int count;
};

/// Moves the line onto the points, starting near it: reweighted least squares with Tukey's bisquare, so that
/// points further off than three times `scale_px` do not count in the end. Fewer than two points leave it as
/// it is.
void fitOffsets(const OffsetPoints& points, double scale_px, OffsetLine& line);

/// A point of the image and its covariance.
struct LineCorner {
  Eigen::Vector2d point;
  Eigen::Matrix2d covariance;  ///< [px^2]
};

/// Where two borders meet, and how well that is known from the spreads of both. Nothing if they are nearly
/// parallel.
std::optional<LineCorner> meet(const Line& a, const Line& b);

/// The same as a corner of the image as it came. \param lens null where that is free of distortion
LineCorner throughLens(const LineCorner& ideal, const geometry::PinholeCamera* lens);

/// A fitted line between two of its points, all of the undistorted image, as an edge of the image as it came.
Edge edgeThroughLens(const Line& line, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                     const geometry::PinholeCamera* lens);

}  // namespace window_ingress::detection
