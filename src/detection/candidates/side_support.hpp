#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "detection/candidates/canny_edges.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// How well the sides of a quadrilateral in the undistorted level lie on straight edges.
/// \param lens camera of the level; null: no distortion
std::array<SideSupport, 4> measureSides(const EdgeMap& map, const geometry::PinholeCamera* lens,
                                        const geometry::Quadrilateral& quad);

/// How well the sides lie on the outline of a blob, however weak its edge. Does not measure overshoot beyond
/// the corners. \param quad in the raw level, as the outline; its sides are assumed straight there
std::array<SideSupport, 4> outlinedSides(const geometry::Quadrilateral& quad,
                                         const std::vector<cv::Point>& outline);

}  // namespace window_ingress::detection
