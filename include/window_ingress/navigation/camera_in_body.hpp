/// The camera's field of view and place on the vehicle, from its calibration and its mounting.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// Where the camera sits and what a level vehicle sees through it.
struct CameraInBody {
  double forward_m = 0.0;           ///< distance ahead of the body's centre [m]
  double horizontal_fov_rad = 0.0;  ///< twice the view to the narrower side of straight ahead [rad]
  double vertical_fov_rad = 0.0;    ///< twice the narrower view above or below straight ahead [rad]
  double pixel_rad = 0.0;           ///< angle covered by a pixel at the image centre [rad]
};

/// \param T_base_camera pose of the optical frame in the body
CameraInBody cameraInBody(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera);

/// Names each value outside the range of the vehicle's parameters; empty if there is none.
std::string faultOf(const CameraInBody& camera);

/// Why this mounting is impossible: the camera does not look forward, or lies outside the body. Empty if no
/// fault is found; a wrong place within the body cannot be detected.
std::string whyNotMounted(const Eigen::Isometry3d& T_base_camera, const VehicleParams& vehicle);

/// The vehicle with this camera in place of its parameters.
VehicleParams withCamera(VehicleParams vehicle, const CameraInBody& camera);

}  // namespace window_ingress::navigation
