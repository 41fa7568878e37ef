#pragma once

#include <Eigen/Core>
#include <vector>

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

/// How well a line goes through points.
struct LineSpread {
  int inliers = 0;              ///< points within twice the scale
  double sum_of_squares = 0.0;  ///< of their distances [px^2]
};

/// Moves the line onto the points, starting near it: reweighted least squares with Tukey's bisquare, so that
/// points further off than a few times `scale_px` do not count. Its point stays where it was along the line.
/// Fewer than two points leave it as it is.
void fitRobustLine(const std::vector<Eigen::Vector2d>& points, double scale_px, Line& line);

LineSpread spreadAbout(const Line& line, const std::vector<Eigen::Vector2d>& points, double scale_px);

}  // namespace window_ingress::detection
