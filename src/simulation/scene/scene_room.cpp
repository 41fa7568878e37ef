#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

using Eigen::Vector3d;

// The inside of a box; its front has holes.
struct Shell {
  Rectangle walls;
  double front_m, back_m;
};

Shell roomShell(const Scenario& scenario, const Scene& scene) {
  return {roomWalls(scenario), scene.opening_depth_m, scene.opening_depth_m + scenario.house.room_depth_m};
}

void addShell(Mesh& mesh, const Shell& shell, const std::vector<Rectangle>& holes, const Surface& paper,
              const Surface& ceiling, const Surface& floor) {
  const Rectangle& room = shell.walls;
  const Vector3d deep(shell.back_m - shell.front_m, 0, 0), across(0, room.left_m - room.right_m, 0);
  const Vector3d up(0, 0, room.top_m - room.bottom_m), corner(shell.front_m, room.right_m, room.bottom_m);
  const double no_shadow_m = room.top_m + 1;
  addWallFace(mesh, shell.front_m, false, room, holes, paper, no_shadow_m);
  addWallFace(mesh, shell.back_m, true, room, {}, paper, no_shadow_m);
  mesh.addQuad(corner, up, deep, paper);
  mesh.addQuad(corner + across, deep, up, paper);
  mesh.addQuad(corner + up, across, deep, ceiling);
  mesh.addQuad(corner, deep, across, floor);
}

// A second shell behind the first, so that nothing shines through where the sun's border cuts it.
void addBacking(Mesh& mesh, const Shell& shell, const Surface& paper) {
  constexpr double kBehind_m = 0.01;
  const Lighting light = mesh.lighting();
  Shell behind{shell.walls.grown(kBehind_m), shell.front_m, shell.back_m + kBehind_m};
  const Surface plain{Texture::kPlain, 0.8 * paper.colour};
  mesh.setLighting(light.inShadow());
  addShell(mesh, behind, {behind.walls}, plain, plain, plain);
  mesh.setLighting(light);
}

void addRoomShell(const Scenario& scenario, Scene& scene) {
  Shell shell = roomShell(scenario, scene);
  const Surface paper = painted(scenario.house.room, wallTexture(scenario.house.room_texture));
  addBacking(scene.mesh, shell, paper);
  shell.walls.bottom_m += 0.005;  // above the lawn
  addShell(scene.mesh, shell, clearHoles(scenario), paper, painted({225, 225, 220}),
           painted({190, 150, 110}, Texture::kWood));
}

void addBackWindow(const Scenario& scenario, Scene& scene) {
  const double back_m = scene.opening_depth_m + scenario.house.room_depth_m;
  const Rectangle opening = backWindow(scenario);
  const Surface white = painted({236, 236, 232});
  addFrame(scene.mesh, opening, 0.06, back_m - 0.03, back_m, white);
  const Lighting light = scene.mesh.lighting();
  scene.mesh.setLighting(skyLight(scenario));
  addPane(scene.mesh, back_m - 0.005, opening, painted({255, 255, 255}, Texture::kView));
  scene.mesh.setLighting(light);
  const double y_m = 0.5 * (opening.right_m + opening.left_m);
  scene.mesh.addBox(box(back_m - 0.025, back_m, {y_m - 0.025, y_m + 0.025, opening.bottom_m, opening.top_m}),
                    white);
}

void addRoomSolids(const Scenario& scenario, Scene& scene) {
  const Rectangle room = roomWalls(scenario), wall = frontWall(scenario);
  const double front_m = scene.opening_depth_m, back_m = front_m + scenario.house.room_depth_m;
  auto& solids = scene.obstacles;
  solids.push_back({"back wall", box(back_m, back_m + 0.2, wall)});
  solids.push_back(
      {"side wall", box(front_m, back_m, {wall.right_m, room.right_m, wall.bottom_m, wall.top_m})});
  solids.push_back(
      {"side wall", box(front_m, back_m, {room.left_m, wall.left_m, wall.bottom_m, wall.top_m})});
  solids.push_back({"ceiling", box(front_m, back_m, {room.right_m, room.left_m, room.top_m, wall.top_m})});
}

void addGables(const Scenario& scenario, Scene& scene) {
  const Rectangle wall = frontWall(scenario);
  const double front_m = scenario.window.wallFront();
  const Surface plaster = painted(scenario.house.wall, Texture::kPlaster);
  const Vector3d deep(scene.opening_depth_m + scenario.house.room_depth_m - front_m, 0, 0);
  const Vector3d up(0, 0, wall.top_m - wall.bottom_m);
  scene.mesh.addQuad({front_m, wall.right_m, wall.bottom_m}, deep, up, plaster);
  scene.mesh.addQuad({front_m, wall.left_m, wall.bottom_m}, up, deep, plaster);
}

}  // namespace

void addRoom(const Scenario& scenario, Scene& scene) {
  addGables(scenario, scene);
  addRoomSolids(scenario, scene);
  const auto clear = clearHoles(scenario);
  if (clear.empty()) return;
  scene.other_clear_holes = clear.size() > 1 || !scenario.window.showsRoom();
  const Lighting outdoors = scene.mesh.lighting();
  scene.mesh.setLighting(roomLight(scenario));
  scene.mesh.setIndoors(true);
  addRoomShell(scenario, scene);
  if (scenario.house.back_window) addBackWindow(scenario, scene);
  if (scenario.house.furniture != "none") addFurniture(scenario, scene);
  scene.mesh.setIndoors(false);
  scene.mesh.setLighting(outdoors);
}

}  // namespace window_ingress::simulation
