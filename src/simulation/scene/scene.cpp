#include "simulation/scene/scene.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

bool reachesInto(const PosterParams& poster, const Scenario& scenario) {
  const double beside_m = 0.5 * (poster.width_m + scenario.window.width_m) + scenario.window.frame_width_m;
  const double above_m = 0.5 * (poster.height_m + scenario.window.height_m) + scenario.window.frame_width_m;
  return std::abs(poster.y_m) < beside_m && std::abs(poster.z_m) < above_m;
}

}  // namespace

Scene buildScene(const Scenario& scenario) {
  const HouseParams& house = scenario.house;
  Scene scene{Mesh(daylight(scenario)), {}, 0.0, 0.0, std::nullopt, false, 0, fogOf(scenario), {}};
  scene.opening_depth_m = scenario.window.wallFront() + house.wall_thickness_m;
  scene.ground_z_m = -scenario.windowCentreHeight();
  if (scenario.window.present) scene.opening = scenario.opening();
  scene.texture_seed = static_cast<std::uint32_t>(house.texture_seed);
  addFront(scenario, scene);
  addTarget(scenario, scene);
  for (const auto& decoy : scenario.decoys) addDecoy(scenario, decoy, scene);
  for (const auto& door : scenario.doors) addDoor(scenario, door, scene);
  for (const auto& poster : scenario.posters) addPoster(scenario, poster, scene);
  addRoof(scenario, scene);
  addGarden(scene);
  addSky(scenario, scene);
  addRoom(scenario, scene);
  return scene;
}

Scenario asPhotographed(const Scenario& scenario) {
  Scenario expected = scenario;
  expected.window.present = true;
  expected.window.closed_by = "none";
  expected.window.dirt = 0.0;
  expected.house.daylight.fog_m = 0.0;
  auto& posters = expected.posters;
  posters.erase(std::remove_if(posters.begin(), posters.end(),
                               [&](const PosterParams& poster) { return reachesInto(poster, scenario); }),
                posters.end());
  return expected;
}

}  // namespace window_ingress::simulation
