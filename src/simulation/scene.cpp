#include "window_ingress/simulation/scene.hpp"

#include <cmath>

#include "scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

Lighting daylight(const HouseParams& house) {
  const double level = std::cos(house.sun_elevation_rad);
  const Eigen::Vector3d towards(-level * std::cos(house.sun_azimuth_rad),
                                level * std::sin(house.sun_azimuth_rad), std::sin(house.sun_elevation_rad));
  return {towards, house.sun, house.ambient};
}

}  // namespace

Scene buildScene(const Scenario& scenario) {
  const HouseParams& house = scenario.house;
  Scene scene{Mesh(daylight(house)), {}, 0.0, 0.0, std::nullopt, 0};
  scene.opening_depth_m = scenario.window.frame_depth_m + house.wall_thickness_m;
  scene.ground_z_m = -scenario.windowCentreHeight();
  if (scenario.window.present) scene.opening = scenario.opening();
  scene.texture_seed = static_cast<std::uint32_t>(house.texture_seed);
  addFront(scenario, scene);
  addTarget(scenario, scene);
  for (const auto& decoy : scenario.decoys) addDecoy(scenario, decoy, scene);
  for (const auto& poster : scenario.posters) addPoster(scenario, poster, scene);
  addRoof(scenario, scene);
  addGarden(scene);
  addSky(scene);
  addRoom(scenario, scene);
  return scene;
}

}  // namespace window_ingress::simulation
