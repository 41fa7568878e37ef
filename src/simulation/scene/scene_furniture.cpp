#include <algorithm>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

// Where the furniture stands.
struct Floor {
  Rectangle room;
  double front_m, back_m, level_m;
};

// Nothing of it stands in the way of somebody who comes through the middle.
void addShelfAndSofa(const Floor& floor, Scene& scene) {
  const Surface oak = painted({150, 110, 75}, Texture::kWood),
                cloth = painted({120, 60, 60}, Texture::kPlaster);
  const Rectangle& room = floor.room;
  const double shelf_top_m = std::min(floor.level_m + 1.9, room.top_m);
  addSolid(scene, "shelf",
           box(floor.back_m - 0.4, floor.back_m,
               {room.right_m + 0.1, room.right_m + 1.2, floor.level_m, shelf_top_m}),
           oak);
  addSolid(scene, "sofa",
           box(floor.back_m - 1.9, floor.back_m - 0.3,
               {room.left_m - 0.9, room.left_m, floor.level_m, floor.level_m + 0.45}),
           cloth);
}

void addPicture(const Floor& floor, Scene& scene) {
  const double back_m = floor.back_m, level_m = floor.level_m;
  scene.mesh.addBox(box(back_m - 0.008, back_m, {-0.25, 0.8, level_m + 1.2, level_m + 1.95}),
                    painted({90, 70, 50}));
  scene.mesh.addPicture({back_m - 0.012, 0.75, level_m + 1.25}, {0, -0.95, 0}, {0, 0, 0.65},
                        {Texture::kPoster, Eigen::Vector3d::Constant(255)});
}

void addTable(const Floor& floor, Scene& scene) {
  const Surface beech = painted({196, 160, 118}, Texture::kWood);
  const double x0 = floor.back_m - 2.3, x1 = x0 + 0.9, right_m = floor.room.right_m + 0.5,
               left_m = std::min(right_m + 1.3, -0.6), level_m = floor.level_m, top_m = level_m + 0.75;
  addSolid(scene, "table", box(x0, x1, {right_m, left_m, top_m - 0.04, top_m}), beech);
  for (const double x : {x0 + 0.03, x1 - 0.09})
    for (const double y : {right_m + 0.03, left_m - 0.09})
      addSolid(scene, "table", box(x, x + 0.06, {y, y + 0.06, level_m, top_m - 0.04}), beech);
  const Surface vase = painted({70, 110, 140}), leaves = painted({120, 150, 90}, Texture::kHedge);
  const double y_m = 0.5 * (right_m + left_m), x_m = 0.5 * (x0 + x1);
  addSolid(scene, "vase", box(x_m - 0.06, x_m + 0.06, {y_m - 0.06, y_m + 0.06, top_m, top_m + 0.2}), vase);
  addSolid(scene, "vase", box(x_m - 0.13, x_m + 0.13, {y_m - 0.13, y_m + 0.13, top_m + 0.2, top_m + 0.42}),
           leaves);
}

void addBooks(const Floor& floor, Scene& scene) {
  const double front_m = floor.back_m - 0.402;
  const ColourParams colours[] = {
      {150, 50, 45}, {50, 80, 120}, {200, 180, 120}, {70, 110, 70}, {120, 90, 130}};
  for (int row = 0; row < 4; ++row)
    for (int i = 0; i < 9; ++i) {
      const double right_m = floor.room.right_m + 0.16 + 0.11 * i,
                   level_m = floor.level_m + 0.15 + 0.42 * row;
      const double high_m = 0.22 + 0.025 * ((7 * i + 3 * row) % 4);
      const Rectangle spine{right_m, right_m + 0.1, level_m, level_m + high_m};
      scene.mesh.addBox(box(front_m - 0.01, front_m + 0.01, spine),
                        painted(colours[(2 * i + row * row) % 5]));
    }
}

void addRugAndLamp(const Floor& floor, Scene& scene) {
  const double level_m = floor.level_m;
  scene.mesh.addQuad({floor.back_m - 3.0, -0.7, level_m + 0.012}, {1.8, 0, 0}, {0, 2.0, 0},
                     painted({150, 120, 105}, Texture::kPlaster));
  const double x_m = floor.back_m - 0.35, y_m = floor.room.left_m - 1.25;
  const Surface metal = painted({90, 90, 95}), shade = painted({245, 232, 200});
  addSolid(scene, "lamp", box(x_m - 0.02, x_m + 0.02, {y_m - 0.02, y_m + 0.02, level_m, level_m + 1.4}),
           metal);
  addSolid(scene, "lamp",
           box(x_m - 0.17, x_m + 0.17, {y_m - 0.17, y_m + 0.17, level_m + 1.4, level_m + 1.68}), shade);
}

}  // namespace

void addFurniture(const Scenario& scenario, Scene& scene) {
  const Rectangle room = roomWalls(scenario);
  const Floor floor{room, scene.opening_depth_m, scene.opening_depth_m + scenario.house.room_depth_m,
                    room.bottom_m};
  addShelfAndSofa(floor, scene);
  if (!scenario.house.back_window) addPicture(floor, scene);
  if (scenario.house.furniture != "full" || scenario.house.room_depth_m < 4.0) return;
  addBooks(floor, scene);
  addTable(floor, scene);
  addRugAndLamp(floor, scene);
}

}  // namespace window_ingress::simulation
