#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::geometry {

/// Inner size of a rectangular opening [m].
struct OpeningSize {
  double width_m = 0.0;
  double height_m = 0.0;
};

/// Corners of the opening's front inner border in the window frame [m], in canonical order as seen from the
/// front: top left, top right, bottom right, bottom left.
std::array<Eigen::Vector3d, 4> openingCorners(const OpeningSize& size);

/// Image of the opening; nothing unless all four corners lie in front of the camera.
std::optional<Quadrilateral> projectOpening(const PinholeCamera& camera,
                                            const Eigen::Isometry3d& T_camera_window,
                                            const OpeningSize& size);

}  // namespace window_ingress::geometry
