#pragma once

#include <string>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/pose/pose_params.hpp"

namespace window_ingress::pose {

/// What is wrong with the corners of an observation, with numbers; empty if a pose can be tried.
std::string faultOfCorners(const detection::WindowObservation& window, const geometry::PinholeCamera& camera,
                           const PoseParams& params);

/// The same observation with corners, covariances and edges in canonical order: clockwise, and started so
/// that top and bottom borders are those that lie apart along `up_camera`. Corners must be strictly convex.
detection::WindowObservation upright(const detection::WindowObservation& window,
                                     const Eigen::Vector3d& up_camera = Eigen::Vector3d(0, -1, 0));

}  // namespace window_ingress::pose
