#include <algorithm>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

using Eigen::Vector3d;

// The inside of a box with holes in its front.
struct Shell {
  Rectangle walls;
  double front_m, back_m;
};

Shell roomShell(const Scenario& scenario, const Scene& scene) {
  return {roomWalls(scenario), scene.opening_depth_m, scene.opening_depth_m + scenario.house.room_depth_m};
}

// Neither blocks the way through the middle.
void addShelfAndSofa(const Shell& room, Scene& scene) {
  const Surface oak = painted({150, 110, 75}, Texture::kWood),
                cloth = painted({120, 60, 60}, Texture::kPlaster);
  const auto [right_m, left_m, level_m, top_m] = room.walls;
  const double shelf_top_m = std::min(level_m + 1.9, top_m);
  addSolid(scene, "shelf",
           box(room.back_m - 0.4, room.back_m, {right_m + 0.1, right_m + 1.2, level_m, shelf_top_m}), oak);
  addSolid(scene, "sofa",
           box(room.back_m - 1.9, room.back_m - 0.3, {left_m - 0.9, left_m, level_m, level_m + 0.45}), cloth);
}

void addPicture(const Shell& room, Scene& scene) {
  const double back_m = room.back_m, level_m = room.walls.bottom_m;
  scene.mesh.addBox(box(back_m - 0.008, back_m, {-0.25, 0.8, level_m + 1.2, level_m + 1.95}),
                    painted({90, 70, 50}));
  scene.mesh.addPicture({back_m - 0.012, 0.75, level_m + 1.25}, {0, -0.95, 0}, {0, 0, 0.65},
                        {Texture::kPoster, Eigen::Vector3d::Constant(255)});
}

void addTable(const Shell& room, Scene& scene) {
  const Surface beech = painted({196, 160, 118}, Texture::kWood);
  const double x0 = room.back_m - 2.3, x1 = x0 + 0.9, right_m = room.walls.right_m + 0.5,
               left_m = std::min(right_m + 1.3, -0.6), level_m = room.walls.bottom_m, top_m = level_m + 0.75;
  addSolid(scene, "table", box(x0, x1, {right_m, left_m, top_m - 0.04, top_m}), beech);
  for (const double x : {x0 + 0.03, x1 - 0.09})
    for (const double y : {right_m + 0.03, left_m - 0.09})
      addSolid(scene, "table", box(x, x + 0.06, {y, y + 0.06, level_m, top_m - 0.04}), beech);
  const Surface vase = painted({70, 110, 140}), leaves = painted({120, 150, 90}, Texture::kHedge);
  const double y_m = 0.5 * (right_m + left_m), x_m = 0.5 * (x0 + x1);
  addSolid(scene, "vase", pillar(x_m, y_m, 0.06, top_m, top_m + 0.2), vase);
  addSolid(scene, "vase", pillar(x_m, y_m, 0.13, top_m + 0.2, top_m + 0.42), leaves);
}

void addBooks(const Shell& room, Scene& scene) {
  const double front_m = room.back_m - 0.402;
  const ColourParams colours[] = {
      {150, 50, 45}, {50, 80, 120}, {200, 180, 120}, {70, 110, 70}, {120, 90, 130}};
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 9; ++i) {
      const double right_m = room.walls.right_m + 0.16 + 0.11 * i,
                   level_m = room.walls.bottom_m + 0.15 + 0.42 * row;
      const double high_m = 0.22 + 0.025 * ((7 * i + 3 * row) % 4);
      const Rectangle spine{right_m, right_m + 0.1, level_m, level_m + high_m};
      scene.mesh.addBox(box(front_m - 0.01, front_m + 0.01, spine),
                        painted(colours[(2 * i + row * row) % 5]));
    }
}

void addRugAndLamp(const Shell& room, Scene& scene) {
  const double level_m = room.walls.bottom_m;
  scene.mesh.addQuad({room.back_m - 3.0, -0.7, level_m + 0.012}, {1.8, 0, 0}, {0, 2.0, 0},
                     painted({150, 120, 105}, Texture::kPlaster));
  const double x_m = room.back_m - 0.35, y_m = room.walls.left_m - 1.25;
  const Surface metal = painted({90, 90, 95}), shade = painted({245, 232, 200});
  addSolid(scene, "lamp", pillar(x_m, y_m, 0.02, level_m, level_m + 1.4), metal);
  addSolid(scene, "lamp", pillar(x_m, y_m, 0.17, level_m + 1.4, level_m + 1.68), shade);
}

void addShell(Mesh& mesh, const Shell& shell, const std::vector<Rectangle>& holes, const Surface& paper,
              const Surface& ceiling, const Surface& floor) {
  const Rectangle& room = shell.walls;
  const Vector3d corner = room.corner(shell.front_m), deep(shell.back_m - shell.front_m, 0, 0);
  const Vector3d across = room.across(), up = room.up();
  const double no_shadow_m = room.top_m + 1;
  addWallFace(mesh, shell.front_m, false, room, holes, paper, no_shadow_m);
  addWallFace(mesh, shell.back_m, true, room, {}, paper, no_shadow_m);
  mesh.addQuad(corner, up, deep, paper);
  mesh.addQuad(corner + across, deep, up, paper);
  mesh.addQuad(corner + up, across, deep, ceiling);
  mesh.addQuad(corner, deep, across, floor);
}

// A second shell behind the first, so that nothing shines through where the sun's border cuts the first.
void addBacking(Mesh& mesh, const Shell& shell, const Surface& paper) {
  constexpr double kBehind_m = 0.01;
  const Shell behind{shell.walls.grown(kBehind_m), shell.front_m, shell.back_m + kBehind_m};
  const Surface plain{Texture::kPlain, 0.8 * paper.colour};
  const LitBy shadow(mesh.lighting().inShadow(), mesh);
  addShell(mesh, behind, {behind.walls}, plain, plain, plain);
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
  const double back_m = roomShell(scenario, scene).back_m;
  const Rectangle opening = backWindow(scenario);
  const Surface white = painted({236, 236, 232});
  addFrame(scene.mesh, opening, 0.06, back_m - 0.03, back_m, white);
  const double y_m = 0.5 * (opening.right_m + opening.left_m);
  scene.mesh.addBox(box(back_m - 0.025, back_m, {y_m - 0.025, y_m + 0.025, opening.bottom_m, opening.top_m}),
                    white);
  const LitBy sky(skyLight(scenario), scene.mesh);
  addPane(scene.mesh, back_m - 0.005, opening, painted({255, 255, 255}, Texture::kView));
}

void addRoomSolids(const Scenario& scenario, Scene& scene) {
  const auto [room, front_m, back_m] = roomShell(scenario, scene);
  const Rectangle wall = frontWall(scenario);
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
  scene.mesh.addQuad(wall.corner(front_m), deep, wall.up(), plaster);
  scene.mesh.addQuad({front_m, wall.left_m, wall.bottom_m}, wall.up(), deep, plaster);
}

void addFurniture(const Scenario& scenario, Scene& scene) {
  const Shell room = roomShell(scenario, scene);
  addShelfAndSofa(room, scene);
  if (!scenario.house.back_window) addPicture(room, scene);
  if (scenario.house.furniture != "full" || scenario.house.room_depth_m < 4.0) return;
  addBooks(room, scene);
  addTable(room, scene);
  addRugAndLamp(room, scene);
}

}  // namespace

void addRoom(const Scenario& scenario, Scene& scene) {
  addGables(scenario, scene);
  addRoomSolids(scenario, scene);
  const auto clear = clearHoles(scenario);
  if (clear.empty()) return;
  scene.other_clear_holes = clear.size() > 1 || !scenario.window.showsRoom();
  const LitBy light(roomLight(scenario), scene.mesh);
  scene.mesh.setIndoors(true);
  addRoomShell(scenario, scene);
  if (scenario.house.back_window) addBackWindow(scenario, scene);
  if (scenario.house.furniture != "none") addFurniture(scenario, scene);
  scene.mesh.setIndoors(false);
}

}  // namespace window_ingress::simulation
