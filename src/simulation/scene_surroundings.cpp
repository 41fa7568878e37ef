#include <algorithm>
#include <cmath>

#include "scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

using Eigen::Vector3d;

void addSolid(Scene& scene, const std::string& name, const Eigen::AlignedBox3d& solid,
              const Surface& surface) {
  scene.mesh.addBox(solid, surface);
  scene.obstacles.push_back({name, solid});
}

void addTree(Scene& scene, double x_m, double y_m, double size_m) {
  const double ground_m = scene.ground_z_m;
  const Surface bark = painted({110, 85, 65}, Texture::kWood),
                leaves = painted({150, 170, 140}, Texture::kHedge);
  addSolid(scene, "tree", box(x_m - 0.15, x_m + 0.15, {y_m - 0.15, y_m + 0.15, ground_m, ground_m + size_m}),
           bark);
  for (int tier = 0; tier < 3; ++tier) {
    const double half_m = size_m * (0.55 - 0.13 * tier), low_m = ground_m + size_m * (0.55 + 0.35 * tier);
    const Rectangle crown{y_m - half_m, y_m + half_m, low_m, low_m + 0.4 * size_m};
    scene.mesh.addBox(box(x_m - half_m, x_m + half_m, crown), leaves);
  }
}

Lighting indoors(const HouseParams& house) {
  return {Vector3d(-0.8, 0.25, 0.55).normalized(), 0.5 * house.room_light, 0.75 * house.room_light};
}

void addRoomShell(const Scenario& scenario, Scene& scene) {
  const Rectangle room = roomWalls(scenario);
  const double front_m = scene.opening_depth_m, back_m = front_m + scenario.house.room_depth_m;
  const Vector3d deep(back_m - front_m, 0, 0), across(0, room.left_m - room.right_m, 0);
  const Vector3d up(0, 0, room.top_m - room.bottom_m), corner(front_m, room.right_m, room.bottom_m);
  const Surface paper = painted({205, 200, 180}, Texture::kPlaster);
  std::vector<Rectangle> holes;
  if (scenario.window.present) holes.push_back(targetOpening(scenario));
  addWallFace(scene.mesh, front_m, false, room, holes, paper, room.top_m + 1);
  addWallFace(scene.mesh, back_m, true, room, {}, paper, room.top_m + 1);
  scene.mesh.addQuad(corner, up, deep, paper);
  scene.mesh.addQuad(corner + across, deep, up, paper);
  scene.mesh.addQuad(corner + up, across, deep, painted({225, 225, 220}));
  scene.mesh.addQuad(corner + Vector3d(0, 0, 0.005), deep, across, painted({190, 150, 110}, Texture::kWood));
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

void addFurniture(const Scenario& scenario, Scene& scene) {
  const Rectangle room = roomWalls(scenario);
  const double back_m = scene.opening_depth_m + scenario.house.room_depth_m, floor_m = room.bottom_m;
  const Surface oak = painted({150, 110, 75}, Texture::kWood),
                cloth = painted({120, 60, 60}, Texture::kPlaster);
  const double shelf_top_m = std::min(floor_m + 1.9, room.top_m);
  addSolid(scene, "shelf",
           box(back_m - 0.4, back_m, {room.right_m + 0.1, room.right_m + 1.2, floor_m, shelf_top_m}), oak);
  addSolid(scene, "sofa",
           box(back_m - 1.9, back_m - 0.3, {room.left_m - 0.9, room.left_m, floor_m, floor_m + 0.45}), cloth);
  const Vector3d left_bottom(back_m - 0.01, 0.75, floor_m + 1.25);
  scene.mesh.addBox(box(back_m - 0.008, back_m, {-0.25, 0.8, floor_m + 1.2, floor_m + 1.95}),
                    painted({90, 70, 50}));
  scene.mesh.addPicture(left_bottom, {0, -0.95, 0}, {0, 0, 0.65},
                        {Texture::kPoster, Vector3d::Constant(255)});
}

}  // namespace

Rectangle roomWalls(const Scenario& scenario) {
  const Rectangle wall = frontWall(scenario);
  const double half_m = std::min(2.6, wall.left_m - 0.2);
  const double least_half_m = 0.5 * scenario.window.width_m, least_top_m = 0.5 * scenario.window.height_m;
  const double top_m = std::max(wall.bottom_m + 2.6, least_top_m + 0.05);
  return {-std::max(half_m, least_half_m), std::max(half_m, least_half_m), wall.bottom_m,
          std::min(top_m, wall.top_m)};
}

void addGarden(Scene& scene) {
  const double ground_m = scene.ground_z_m;
  scene.mesh.addQuad({-400, -400, ground_m}, {800, 0, 0}, {0, 800, 0},
                     painted({190, 195, 165}, Texture::kGrass));
  scene.mesh.addQuad({-2.2, -7, ground_m + 0.01}, {2.2, 0, 0}, {0, 14, 0},
                     painted({205, 200, 195}, Texture::kPaving));
  const Surface hedge = painted({180, 185, 170}, Texture::kHedge);
  const double top_m = ground_m + 2.1;
  addSolid(scene, "hedge", box(-19, -18, {-18, 18, ground_m, top_m}), hedge);
  addSolid(scene, "hedge", box(-19, 18, {18, 19, ground_m, top_m}), hedge);
  addSolid(scene, "hedge", box(-19, 18, {-19, -18, ground_m, top_m}), hedge);
  addTree(scene, -21, 7, 4.5);
  addTree(scene, -23, -9, 5.5);
  addTree(scene, -5, 21, 5.0);
  addTree(scene, -2, -22, 4.0);
  addTree(scene, -13, -20.5, 5.0);
}

// Clouds on a plane overhead, haze around the horizon: no corners that a detector could like.
void addSky(Scene& scene) {
  const Lighting outdoors = scene.mesh.lighting();
  scene.mesh.setLighting({Vector3d::UnitZ(), 0.0, 1.0});
  constexpr int kSides = 24;
  const double far_m = 450.0, low_m = scene.ground_z_m - 30.0, high_m = 45.0;
  const auto ring = [&](int i, double radius_m, double z_m) {
    const double angle = 2.0 * M_PI * i / kSides;
    return Vector3d(radius_m * std::cos(angle), radius_m * std::sin(angle), z_m);
  };
  const Surface haze = painted({190, 209, 236}), air = painted({206, 227, 255}, Texture::kClouds);
  for (int i = 0; i < kSides; ++i) {
    const Vector3d a = ring(i, far_m, low_m), b = ring(i + 1, far_m, low_m), up(0, 0, high_m - low_m);
    scene.mesh.addQuad(b, a - b, up, haze);
  }
  scene.mesh.addQuad({-far_m, -far_m, high_m}, {0, 2 * far_m, 0}, {2 * far_m, 0, 0}, air);
  scene.mesh.setLighting(outdoors);
}

void addRoom(const Scenario& scenario, Scene& scene) {
  const Lighting outdoors = scene.mesh.lighting();
  const Rectangle wall = frontWall(scenario);
  const double back_m = scene.opening_depth_m + scenario.house.room_depth_m;
  const Surface plaster = painted(scenario.house.wall, Texture::kPlaster);
  const Vector3d deep(back_m, 0, 0), up(0, 0, wall.top_m - wall.bottom_m);
  const double front_m = scenario.window.frame_depth_m;
  scene.mesh.addQuad({front_m, wall.right_m, wall.bottom_m}, deep, up, plaster);
  scene.mesh.addQuad({front_m, wall.left_m, wall.bottom_m}, up, deep, plaster);
  scene.mesh.setLighting(indoors(scenario.house));
  scene.mesh.setIndoors(true);
  addRoomShell(scenario, scene);
  addFurniture(scenario, scene);
  scene.mesh.setIndoors(false);
  scene.mesh.setLighting(outdoors);
  addRoomSolids(scenario, scene);
}

}  // namespace window_ingress::simulation
