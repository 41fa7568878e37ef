#pragma once

#include <array>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// What the edge map says about one side of a candidate.
struct SideSupport {
  double fraction = 0.0;   ///< part of the side that runs along edge pixels of its direction
  double contrast = 0.0;   ///< mean gradient under it [grey levels a pixel]
  double overshoot = 0.0;  ///< part of the stretches beyond its two ends where the edge goes on, as in a grid
  double polarity = 0.0;   ///< +1 brighter inside all along, -1 darker inside all along
};

/// A quadrilateral that may be the window, in pixels of the search level, canonical order.
struct Candidate {
  geometry::Quadrilateral quad = {
      Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
      Eigen::Vector2d::Zero()};  ///< of the undistorted level, where its sides are straight
  geometry::Quadrilateral seen = {Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                  Eigen::Vector2d::Zero()};  ///< of the level as it came
  CandidateSource source = CandidateSource::kContour;
  double solidity = 1.0;  ///< area of the outline over area of its hull
  double closure =
      1.0;  ///< 1: its sides end in its corners; towards 0 the further they stop short or run beyond
  std::array<SideSupport, 4> sides;
};

}  // namespace window_ingress::detection
