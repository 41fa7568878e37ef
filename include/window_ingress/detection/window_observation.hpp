#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One point of the texture within the opening, in two images. Pixels of the images as they came
/// (distorted).
struct InteriorPoint {
  std::uint16_t id = 0;  ///< the same in all images that are compared with one key image
  Eigen::Vector2d key_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d now_px = Eigen::Vector2d::Zero();
  /// Of a point on an edge: the direction across it in this image, in which alone its place is known. Zero
  /// of a corner, whose place is known in both directions.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  /// Cells of the opening, 6 x 6, one bit each, row by row from the top left one, that are filled by a region
  /// without edges that ends at this point: what is seen there is as deep as the point at least.
  std::uint64_t beside = 0;
};

/// What became, since a key image, of the texture that is seen within the opening. Without points: nothing
/// to compare with.
struct InteriorTracks {
  double key_stamp_sec = 0.0;  ///< exposure of the key image; that of this one: it is the key itself
  /// The opening's inner border in the key image, all four corners of it, and their covariances [px^2].
  geometry::Quadrilateral key_corners = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                         Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<Eigen::Matrix2d, 4> key_covariance = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                                   Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  double sigma_px = 0.0;  ///< of the way of a point from the key image to this one, each axis [px]
  std::vector<InteriorPoint> points;

  bool empty() const { return points.empty(); }
};

/// One border of the opening as measured in the image.
struct Edge {
  bool visible = false;   ///< false: cut away or not found; then nothing else of it may be used
  double sigma_px = 0.0;  ///< standard deviation of the fitted line across itself, at its middle [px]
  /// Standard deviation of the line's direction [rad].
  double sigma_rad = 0.0;
  /// Ends of the stretch that was seen, on the fitted line, clockwise about the window; its middle is the
  /// line's. Pixels of the image as it came (distorted). Both zero where only corners are known.
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
};

/// The target window in one image: what the detector knows and nothing that it guesses.
///
/// A *partial* observation has borders but not all corners: near the window its sides leave the image. A
/// corner that was not seen is zero, its covariance too, and must not be read; its borders remain.
struct WindowObservation {
  double stamp_sec = 0.0;  ///< exposure time of the image it was seen in
  std::uint32_t target_id =
      0;  ///< the same while it is certain to be the same window; from 1; 0: not tracked
  /// Inner border of the opening's front, canonical order, in pixels of the image as it came (distorted).
  geometry::Quadrilateral corners = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                     Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<bool, 4> corner_visible = {true, true, true, true};  ///< in the order of the corners
  /// Covariance of each corner [px^2], from the two edges that meet in it.
  std::array<Eigen::Matrix2d, 4> corner_covariance = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                                      Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  std::array<Edge, 4> edges;    ///< top, right, bottom, left
  double score = 0.0;           ///< 0 (barely passed the gates) to 1 (certain)
  bool has_appearance = false;  ///< a reference was given and enough pixels could be compared
  double bhattacharyya = 0.0;   ///< 0 identical to 1 disjoint; only if has_appearance
  double correlation =
      0.0;  ///< of what lies round it with what lies round the reference's opening; 0: not compared
  double runner_up =
      0.0;  ///< the same of the next best place, when it was searched for: near it, they look alike
  InteriorTracks interior;  ///< what the texture within the opening did; empty unless it was followed

  /// All four corners are seen: `corners` may be read as a quadrilateral.
  bool whole() const {
    return std::all_of(corner_visible.begin(), corner_visible.end(), [](bool seen) { return seen; });
  }
  int visibleSides() const {
    return static_cast<int>(
        std::count_if(edges.begin(), edges.end(), [](const Edge& edge) { return edge.visible; }));
  }
};

}  // namespace window_ingress::detection
