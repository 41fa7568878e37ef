#include "window_ingress/navigation/camera_in_body.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kWidestFovRad = 2.8;  // wider fields of view count as this one
constexpr double kLooksForward = 0.7;  // least forward component of the optical axis: some 45 degrees
constexpr double kBesideBodyM = 0.02;

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
  const auto faults = parameters::outOfRange(camera);
  if (faults.empty()) return "";
  return "camera_info or mounting of the camera: " + parameters::joined(faults) +
         "; a field of view counts twice its narrower side of the body's forward axis: is the camera tilted "
         "too far?";
}

std::string whyNotMounted(const Eigen::Isometry3d& T_base_camera, const VehicleParams& vehicle) {
  const Eigen::Vector3d axis = T_base_camera.linear().col(2), at = T_base_camera.translation();
  if (!(axis.x() >= kLooksForward))
    return formatted(
        "the camera does not look forward: its optical axis is (%.2f, %.2f, %.2f) in the body; angles are "
        "radians, an optical frame has z forward",
        axis.x(), axis.y(), axis.z());
  const Eigen::Vector3d half(vehicle.half_length_m, vehicle.half_width_m, vehicle.half_height_m);
  if ((at.cwiseAbs() - half).maxCoeff() <= kBesideBodyM) return "";
  return formatted(
      "the camera, at (%.2f, %.2f, %.2f) m, lies outside of the vehicle, which reaches %g x %g x %g m from "
      "its middle: measure both (camera_pose, vehicle/half_length_m, half_width_m, half_height_m)",
      at.x(), at.y(), at.z(), half.x(), half.y(), half.z());
}

}  // namespace window_ingress::navigation
