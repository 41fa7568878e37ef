#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "detection/candidates/canny_edges.hpp"
#include "detection/candidates/undistortion_map.hpp"

namespace window_ingress::detection {

/// How well the sides of a quadrilateral of the undistorted level run along straight edges.
std::array<SideSupport, 4> measureSides(const EdgeMap& map, const UndistortionMap& lens,
                                        const geometry::Quadrilateral& quad);

/// How well they run along the outline of a blob, however weak the edge there; nothing is known beyond their
/// corners. \param quad of the level as it came, as the outline is; its sides are taken as straight there
std::array<SideSupport, 4> outlinedSides(const geometry::Quadrilateral& quad,
                                         const std::vector<cv::Point>& outline);

}  // namespace window_ingress::detection
