#include "flight_facts.hpp"

#include <cmath>

#include "window_ingress/configuration/overlay.hpp"

namespace window_ingress::evaluation {
namespace {

// Of the vehicle, as far as the operator does not say otherwise.
void tellVehicle(const simulation::World& world, const std::set<std::string>& said,
                 navigation::VehicleParams& vehicle) {
  const auto tell = [&](const char* name, double& value, double fact) {
    if (said.count(std::string("vehicle/") + name) == 0) value = fact;
  };
  const auto camera = world.camera();
  const Eigen::Vector3d half = world.vehicleHalfExtents();
  tell("half_length_m", vehicle.half_length_m, half.x());
  tell("half_width_m", vehicle.half_width_m, half.y());
  tell("half_height_m", vehicle.half_height_m, half.z());
  tell("camera_forward_m", vehicle.camera_forward_m, world.T_base_camera().translation().x());
  tell("horizontal_fov_rad", vehicle.horizontal_fov_rad, 2.0 * std::atan(camera.width / (2.0 * camera.fx)));
  tell("vertical_fov_rad", vehicle.vertical_fov_rad, 2.0 * std::atan(camera.height / (2.0 * camera.fy)));
  tell("pixel_rad", vehicle.pixel_rad, 1.0 / camera.fx);
  tell("exposure_sec", vehicle.exposure_sec, world.scenario().camera.exposure_sec);
}

void tellOpening(const simulation::World& world, const std::set<std::string>& said, pose::PoseParams& pose) {
  if (pose.scale_sigma > 0.0 || pose.aspect_sigma > 0.0) return;  // to be found out
  const auto isSaid = [&](const char* name) { return said.count(name) > 0; };
  if (!isSaid("homography_pose/pose/opening_width_m")) pose.opening_width_m = world.opening().width_m;
  if (!isSaid("homography_pose/pose/opening_height_m")) pose.opening_height_m = world.opening().height_m;
}

}  // namespace

FlightParams readFlightParams(const std::string& file) {
  const configuration::Overlay overlay = configuration::readOverlay(file);
  FlightParams params;
  params.detector = overlay.window_detector.detector;
  params.interior = overlay.window_detector.interior;
  params.pose = overlay.homography_pose.pose;
  params.filter = overlay.homography_pose.filter;
  params.tracker = overlay.homography_pose.tracker;
  params.navigator = overlay.ingress_navigator.navigator;
  params.step_rate_hz = overlay.ingress_navigator.rate_hz;
  params.said = overlay.said;
  return params;
}

FlightParams withFactsOf(const simulation::World& world, FlightParams params) {
  tellVehicle(world, params.said, params.navigator.vehicle);
  params.tracker = navigation::forVehicle(params.tracker, params.navigator.vehicle);
  tellOpening(world, params.said, params.pose);
  const std::string &glass = world.scenario().glass, &opening_policy = world.scenario().unverified_opening;
  auto& commit = params.navigator.commit;
  if (glass != "as_set") commit.glass = glass;
  if (opening_policy != "as_set") commit.unverified_opening = opening_policy;
  if (params.without_pictures)
    commit.glass = "excluded", commit.unverified_opening = "allow";  // nothing shows it
  return params;
}

}  // namespace window_ingress::evaluation
