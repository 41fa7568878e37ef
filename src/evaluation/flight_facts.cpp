#include "flight_facts.hpp"

#include <cmath>

namespace window_ingress::evaluation {

FlightParams withFactsOf(const simulation::World& world, FlightParams params) {
  const auto camera = world.camera();
  const Eigen::Vector3d half = world.vehicleHalfExtents();
  auto& vehicle = params.navigator.vehicle;
  vehicle.half_length_m = half.x();
  vehicle.half_width_m = half.y();
  vehicle.half_height_m = half.z();
  vehicle.camera_forward_m = world.T_base_camera().translation().x();
  vehicle.horizontal_fov_rad = 2.0 * std::atan(camera.width / (2.0 * camera.fx));
  vehicle.vertical_fov_rad = 2.0 * std::atan(camera.height / (2.0 * camera.fy));
  vehicle.pixel_rad = 1.0 / camera.fx;
  vehicle.exposure_sec = world.scenario().camera.exposure_sec;
  const std::string& opening_policy = world.scenario().unverified_opening;
  if (opening_policy != "as_set") params.navigator.commit.unverified_opening = opening_policy;
  if (params.without_pictures) params.navigator.commit.unverified_opening = "allow";  // nothing shows it
  params.tracker = navigation::forVehicle(params.tracker, vehicle);
  if (params.pose.scale_sigma > 0.0 || params.pose.aspect_sigma > 0.0) return params;  // to be found out
  params.pose.opening_width_m = world.opening().width_m;
  params.pose.opening_height_m = world.opening().height_m;
  return params;
}

}  // namespace window_ingress::evaluation
