#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One point of the texture within the opening, in two images; distorted pixels.
struct InteriorPoint {
  std::uint16_t id = 0;  ///< the same in all images compared with one keyframe
  Eigen::Vector2d key_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d now_px = Eigen::Vector2d::Zero();
  /// For a point on an edge: the direction across the edge in this image, the only one in which its place is
  /// known. Zero for a corner, whose place is known in both directions.
  Eigen::Vector2d normal = Eigen::Vector2d::Zero();
  /// Cells of the opening (6 x 6, one bit each, row by row from the top left) filled by a region without
  /// edges that ends at this point. That region is at least as deep as the point.
  std::uint64_t beside = 0;
};

/// Motion of the texture within the opening since a keyframe. Without points there is nothing to compare.
struct InteriorTracks {
  double key_stamp_sec = 0.0;  ///< exposure of the keyframe; equal to this image's if this is the keyframe
  /// The four corners of the opening's inner border in the keyframe and their covariances [px^2].
  geometry::Quadrilateral key_corners = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                         Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero()};
  std::array<Eigen::Matrix2d, 4> key_covariance = {Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero(),
                                                   Eigen::Matrix2d::Zero(), Eigen::Matrix2d::Zero()};
  double sigma_px = 0.0;  ///< of a point's motion from the keyframe to this image, each axis [px]
  std::vector<InteriorPoint> points;

  bool empty() const { return points.empty(); }
};

/// One border of the opening as measured in the image.
struct Edge {
  bool visible = false;   ///< false: cut off or not found, all other fields are invalid
  double sigma_px = 0.0;  ///< standard deviation across the fitted line, at its middle [px]
  /// Standard deviation of the line's direction [rad].
  double sigma_rad = 0.0;
  /// Ends of the visible part on the fitted line, clockwise about the window; "middle" above means the middle
  /// of this part. Distorted pixels. Both are zero if only corners are known.
  Eigen::Vector2d a = Eigen::Vector2d::Zero(), b = Eigen::Vector2d::Zero();
};

/// The target window in one image: only what was measured, no guesses.
///
/// A *partial* observation has borders but not all corners: near the window its sides leave the image. A
/// corner that was not seen and its covariance are zero and must not be read; its borders remain valid.
struct WindowObservation {
  double stamp_sec = 0.0;       ///< exposure time of the image it was seen in
  std::uint32_t target_id = 0;  ///< constant while it is certainly the same window; from 1; 0: not tracked
  /// Inner border of the opening's front, canonical order, distorted pixels.
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
  double correlation = 0.0;     ///< of its surroundings with the reference's; 0: not compared
  double runner_up = 0.0;       ///< correlation of the search's next best place; if similar, both look alike
  InteriorTracks interior;      ///< texture within the opening; empty unless it was tracked

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
