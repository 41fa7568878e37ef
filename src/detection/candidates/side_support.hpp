#pragma once

#include <array>

#include "detection/candidates/candidate.hpp"
#include "detection/candidates/canny_edges.hpp"
#include "detection/candidates/level_camera.hpp"

namespace window_ingress::detection {

/// How well the sides of a quadrilateral of the undistorted level run along straight edges.
std::array<SideSupport, 4> measureSides(const EdgeMap& map, const LevelCamera& lens,
                                        const geometry::Quadrilateral& quad);

}  // namespace window_ingress::detection
