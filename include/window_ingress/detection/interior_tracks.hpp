#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One point of the texture within the opening, in two pictures. Pixels of the images as they came
/// (distorted).
struct InteriorPoint {
  std::uint16_t id = 0;  ///< the same in all pictures that are compared with one key picture
  Eigen::Vector2d key_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d now_px = Eigen::Vector2d::Zero();
  /// Of a point on an edge: the direction across it in this picture, in which alone its place is known. Zero
  /// of a corner, whose place is known in both directions.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  /// Cells of the opening, 6 x 6, one bit each, row by row from the top left one, that are filled by a region
  /// without edges that ends at this point: what is seen there is as deep as the point at least.
  std::uint64_t beside = 0;
};

/// What became, since a key picture, of the texture that is seen within the opening. Without points: nothing
/// to compare with.
struct InteriorTracks {
  double key_stamp_sec = 0.0;  ///< exposure of the key picture; that of this one: it is the key itself
  /// The opening's inner border in the key picture, all four corners of it, and their covariances [px^2].
  geometry::Quadrilateral key_corners = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                         Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<Eigen::Matrix2d, 4> key_covariance = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                                   Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  double sigma_px = 0.0;  ///< of the way of a point from the key picture to this one, each axis [px]
  std::vector<InteriorPoint> points;

  bool empty() const { return points.empty(); }
};

}  // namespace window_ingress::detection
