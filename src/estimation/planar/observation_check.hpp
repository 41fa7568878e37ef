#pragma once

#include <string>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// What is wrong with the corners of an observation, with numbers; empty if a pose can be tried. A partial
/// observation must show all four borders.
std::string faultOfCorners(const detection::WindowObservation& window, const geometry::PinholeCamera& camera);

/// False for a partial observation rolled by 45 degrees or more, because the image names its borders. Whole
/// observations are put upright.
bool isUpright(const detection::WindowObservation& window, const Eigen::Vector3d& up_camera);

/// The same observation with corners, covariances and edges in canonical order: clockwise, and started so
/// that top and bottom borders are those that lie apart along `up_camera`. Corners must be strictly convex.
/// A partial observation stays as it is.
detection::WindowObservation upright(const detection::WindowObservation& window,
                                     const Eigen::Vector3d& up_camera = Eigen::Vector3d(0, -1, 0));

}  // namespace window_ingress::estimation
