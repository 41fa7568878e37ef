#include <cmath>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

using Eigen::Vector3d;

/// Dimensions of the roof.
struct Roof {
  double depth_m, side_m, low_m, high_m;
};

Roof roofOf(const Scenario& scenario) {
  const Rectangle wall = frontWall(scenario);
  const double depth_m =
      scenario.window.wallFront() + scenario.house.wall_thickness_m + scenario.house.room_depth_m;
  const double low_m = wall.top_m - 0.02;
  return {depth_m, wall.left_m + 0.3, low_m, low_m + 0.45 * (0.5 * depth_m)};
}

void addTree(Scene& scene, double x_m, double y_m, double size_m) {
  const double ground_m = scene.ground_z_m;
  const Surface bark = painted({110, 85, 65}, Texture::kWood),
                leaves = painted({150, 170, 140}, Texture::kHedge);
  addSolid(scene, "tree", pillar(x_m, y_m, 0.15, ground_m, ground_m + size_m), bark);
  for (int tier = 0; tier < 3; ++tier) {
    const double half_m = size_m * (0.55 - 0.13 * tier), low_m = ground_m + size_m * (0.55 + 0.35 * tier);
    scene.mesh.addBox(pillar(x_m, y_m, half_m, low_m, low_m + 0.4 * size_m), leaves);
  }
}

}  // namespace

Eigen::AlignedBox3d roofBox(const Scenario& scenario) {
  const auto [depth_m, side_m, low_m, high_m] = roofOf(scenario);
  return box(-kOverhang_m - 0.08, depth_m + kOverhang_m, {-side_m, side_m, low_m - 0.12, high_m});
}

void addRoof(const Scenario& scenario, Scene& scene) {
  const auto [depth_m, side_m, low_m, high_m] = roofOf(scenario);
  const Eigen::Vector3d across(0, -2.0 * side_m, 0);
  const Eigen::Vector3d edge(-kOverhang_m, side_m, low_m), ridge(0.5 * depth_m, side_m, high_m);
  const Surface tiles = painted({230, 215, 205}, Texture::kTiles);
  scene.mesh.addQuad(edge, across, ridge - edge, tiles);
  const Eigen::Vector3d back(depth_m + kOverhang_m, -side_m, low_m);
  scene.mesh.addQuad(back, -across, ridge + across - back, tiles);
  const Rectangle gutter{-side_m, side_m, low_m - 0.12, low_m + 0.03};
  scene.mesh.addBox(box(-kOverhang_m - 0.08, -kOverhang_m + 0.03, gutter), painted({222, 222, 218}));
  const Rectangle soffit{-side_m, side_m, low_m - 0.06, low_m};
  scene.mesh.addBox(box(-kOverhang_m, scenario.window.wallFront(), soffit),
                    painted({175, 140, 100}, Texture::kWood));
  scene.obstacles.push_back({"roof", roofBox(scenario)});
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

// Clouds on a plane overhead, haze around the horizon: no corners that a detector could find.
void addSky(const Scenario& scenario, Scene& scene) {
  const LitBy light(skyLight(scenario), scene.mesh);
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
}

}  // namespace window_ingress::simulation
