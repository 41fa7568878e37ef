#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {

namespace {

/// Where it lies.
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
  const Eigen::AlignedBox3d gutter(Eigen::Vector3d(-kOverhang_m - 0.08, -side_m, low_m - 0.12),
                                   Eigen::Vector3d(-kOverhang_m + 0.03, side_m, low_m + 0.03));
  scene.mesh.addBox(gutter, painted({222, 222, 218}));
  const Rectangle soffit{-side_m, side_m, low_m - 0.06, low_m};
  scene.mesh.addBox(box(-kOverhang_m, scenario.window.wallFront(), soffit),
                    painted({175, 140, 100}, Texture::kWood));
  scene.obstacles.push_back({"roof", roofBox(scenario)});
}

}  // namespace window_ingress::simulation
