#include "window_ingress/navigation/camera_in_body.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/parameters/fields.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kWidestFovRad = 2.8;  // who sees more is taken to see this much

double narrowerTwice(double one_rad, double other_rad) {
  return std::min(kWidestFovRad, 2.0 * std::min(one_rad, other_rad));
}

}  // namespace

CameraInBody cameraInBody(const geometry::PinholeCamera& camera, const Eigen::Isometry3d& T_base_camera) {
  const auto ray = [&](double x_px, double y_px) {
    return Eigen::Vector3d(T_base_camera.linear() * camera.ray({x_px, y_px}));
  };
  const double middle_x_px = 0.5 * (camera.width - 1), middle_y_px = 0.5 * (camera.height - 1);
  const Eigen::Vector3d left = ray(-0.5, middle_y_px), right = ray(camera.width - 0.5, middle_y_px);
  const Eigen::Vector3d top = ray(middle_x_px, -0.5), bottom = ray(middle_x_px, camera.height - 0.5);
  CameraInBody seen;
  seen.forward_m = T_base_camera.translation().x();
  seen.horizontal_fov_rad = narrowerTwice(std::atan2(left.y(), left.x()), -std::atan2(right.y(), right.x()));
  seen.vertical_fov_rad = narrowerTwice(std::atan2(top.z(), top.x()), -std::atan2(bottom.z(), bottom.x()));
  seen.pixel_rad = 1.0 / camera.fx;
  return seen;
}

std::string faultOf(const CameraInBody& camera) {
  const auto faults = parameters::outOfRange(withCamera({}, camera));
  return faults.empty() ? "" : "camera_info or mounting of the camera: " + parameters::joined(faults);
}

VehicleParams withCamera(VehicleParams vehicle, const CameraInBody& camera) {
  vehicle.camera_forward_m = camera.forward_m;
  vehicle.horizontal_fov_rad = camera.horizontal_fov_rad;
  vehicle.vertical_fov_rad = camera.vertical_fov_rad;
  vehicle.pixel_rad = camera.pixel_rad;
  return vehicle;
}

}  // namespace window_ingress::navigation
