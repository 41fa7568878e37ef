/// The camera's field of view and place on the vehicle, from its calibration and its mounting.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// The fields of view are twice the view to the narrower side of straight ahead.
/// \param T_base_camera pose of the optical frame in the body
CameraInBody cameraInBody(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera);

/// Names each value outside the range of the vehicle's parameters; empty if there is none.
std::string faultOf(const CameraInBody& camera);

/// Why this mounting is impossible: the camera does not look forward, or lies outside the body. Empty if no
/// fault is found; a wrong place within the body cannot be detected.
std::string whyNotMounted(const Eigen::Isometry3d& T_base_camera, const VehicleParams& vehicle);

}  // namespace window_ingress::navigation
