#include <cmath>

#include "evaluation/flights/closed_loop_flight.hpp"
#include "evaluation/flights/told_sizes.hpp"
#include "window_ingress/configuration/pose_node_params.hpp"

namespace window_ingress::evaluation {
namespace {

// The nodes take these from camera_info and tf.
void tellCamera(const simulation::World& world, const std::set<std::string>& said,
                navigation::VehicleParams& vehicle) {
  const auto tell = [&](const char* name, double& value, double fact) {
    if (said.count(std::string("vehicle/") + name) == 0) value = fact;
  };
  const auto camera = world.camera();
  auto& told = vehicle.camera;
  tell("camera_forward_m", told.forward_m, world.T_base_camera().translation().x());
  tell("horizontal_fov_rad", told.horizontal_fov_rad, 2.0 * std::atan(camera.width / (2.0 * camera.fx)));
  tell("vertical_fov_rad", told.vertical_fov_rad, 2.0 * std::atan(camera.height / (2.0 * camera.fy)));
  tell("pixel_rad", told.pixel_rad, 1.0 / camera.fx);
  tell("exposure_sec", vehicle.exposure_sec, world.scenario().camera.exposure_sec);
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
  tellSizes(world.scenario(), params.said, navigator.vehicle, params.homography_pose.pose);
  tellCamera(world, params.said, navigator.vehicle);
  params.homography_pose.tracker.needed = configuration::neededBy(navigator.vehicle);
  tellPolicy(world.scenario(), params.said, navigator.commit);
  if (params.without_images)  // no image shows it
    navigator.commit.glass = "excluded", navigator.commit.unverified_opening = "allow";
  return params;
}

}  // namespace window_ingress::evaluation
