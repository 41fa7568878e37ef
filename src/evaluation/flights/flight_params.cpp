#include <cmath>

#include "evaluation/flights/closed_loop_flight.hpp"
#include "window_ingress/configuration/pose_node_params.hpp"

namespace window_ingress::evaluation {
namespace {

// Sets the vehicle's values that the operator does not give.
void tellVehicle(const simulation::World& world, const std::set<std::string>& said,
                 navigation::VehicleParams& vehicle) {
  const auto tell = [&](const char* name, double& value, double fact) {
    if (said.count(std::string("vehicle/") + name) == 0) value = fact;
  };
  const auto camera = world.camera();
  const Eigen::Vector3d half = world.scenario().vehicle.halfExtents();
  tell("half_length_m", vehicle.half_length_m, half.x());
  tell("half_width_m", vehicle.half_width_m, half.y());
  tell("half_height_m", vehicle.half_height_m, half.z());
  tell("camera_forward_m", vehicle.camera_forward_m, world.T_base_camera().translation().x());
  tell("horizontal_fov_rad", vehicle.horizontal_fov_rad, 2.0 * std::atan(camera.width / (2.0 * camera.fx)));
  tell("vertical_fov_rad", vehicle.vertical_fov_rad, 2.0 * std::atan(camera.height / (2.0 * camera.fy)));
  tell("pixel_rad", vehicle.pixel_rad, 1.0 / camera.fx);
  tell("exposure_sec", vehicle.exposure_sec, world.scenario().camera.exposure_sec);
}

void tellOpening(const simulation::World& world, const std::set<std::string>& said,
                 estimation::PoseParams& pose) {
  if (pose.scale_sigma > 0.0 || pose.aspect_sigma > 0.0) return;  // size to be estimated in flight
  const auto isSaid = [&](const char* name) { return said.count(name) > 0; };
  if (!isSaid("homography_pose/pose/opening_width_m")) pose.opening_width_m = world.opening().width_m;
  if (!isSaid("homography_pose/pose/opening_height_m")) pose.opening_height_m = world.opening().height_m;
}

// Sets the policy from the scenario, because there is no operator to ask.
void tellPolicy(const simulation::Scenario& scenario, const std::set<std::string>& said,
                navigation::CommitParams& commit) {
  const auto tell = [&](const char* name, std::string& value, const std::string& policy) {
    const bool is_said = said.count(std::string("ingress_navigator/navigator/commit/") + name) > 0;
    if (policy != "as_set" && !is_said) value = policy;
  };
  tell("glass", commit.glass, scenario.glass);
  tell("unverified_opening", commit.unverified_opening, scenario.unverified_opening);
}

}  // namespace

FlightParams withFactsOf(const simulation::World& world, FlightParams params) {
  navigation::NavigatorParams& navigator = params.ingress_navigator.navigator;
  tellVehicle(world, params.said, navigator.vehicle);
  params.homography_pose.tracker.needed = configuration::neededBy(navigator.vehicle);
  tellOpening(world, params.said, params.homography_pose.pose);
  tellPolicy(world.scenario(), params.said, navigator.commit);
  if (params.without_images)  // no image shows it
    navigator.commit.glass = "excluded", navigator.commit.unverified_opening = "allow";
  return params;
}

}  // namespace window_ingress::evaluation
