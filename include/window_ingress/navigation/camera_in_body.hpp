/// The camera as its calibration and its mounting have it, for whoever has to keep the window in view.
#pragma once

#include <Eigen/Geometry>
#include <string>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// Where the camera sits and what a level vehicle sees through it.
struct CameraInBody {
  double forward_m = 0.0;           ///< of the body's centre [m]
  double horizontal_fov_rad = 0.0;  ///< twice the view to that side of straight ahead which shows less [rad]
  double vertical_fov_rad = 0.0;    ///< likewise, above and below [rad]
  double pixel_rad = 0.0;           ///< angle that a pixel in the image's middle covers [rad]
};

/// \param T_base_camera of the optical frame
CameraInBody cameraInBody(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera);

/// Why nobody can fly by such a camera: a number that is not within the range of the vehicle's parameters.
std::string faultOf(const CameraInBody& camera);

/// Why no vehicle has its camera there: it does not look forward, or lies outside of the body. Empty if
/// nothing speaks against it; a place that is wrong within the body nobody can tell.
std::string whyNotMounted(const Eigen::Isometry3d& T_base_camera, const VehicleParams& vehicle);

/// The vehicle with this camera in place of its parameters.
VehicleParams withCamera(VehicleParams vehicle, const CameraInBody& camera);

}  // namespace window_ingress::navigation
