#include <cmath>

#include "scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kOverhang_m = 0.45;
constexpr double kPaneDepth_m = 0.07;

Surface wallSurface(const HouseParams& house) {
  return painted(house.wall, house.wall_texture == "brick" ? Texture::kBrick : Texture::kPlaster);
}

Rectangle decoyOpening(const DecoyParams& decoy) {
  return Rectangle::around(decoy.y_m, decoy.z_m, decoy.width_m, decoy.height_m);
}

// Height of the lower border of the shadow that the eaves throw on the wall.
double shadowHeight(const Scenario& scenario) {
  const double top_m = frontWall(scenario).top_m;
  return top_m -
         kOverhang_m * std::tan(scenario.house.sun_elevation_rad) / std::cos(scenario.house.sun_azimuth_rad);
}

}  // namespace

Rectangle frontWall(const Scenario& scenario) {
  const double half_m = 0.5 * scenario.house.width_m, ground_m = -scenario.windowCentreHeight();
  return {-half_m, half_m, ground_m, ground_m + scenario.house.eaves_m};
}

Rectangle targetOpening(const Scenario& scenario) {
  return Rectangle::around(0, 0, scenario.window.width_m, scenario.window.height_m);
}

void addFront(const Scenario& scenario, Scene& scene) {
  std::vector<Rectangle> holes;
  if (scenario.window.present) holes.push_back(targetOpening(scenario));
  for (const auto& decoy : scenario.decoys) holes.push_back(decoyOpening(decoy));
  const Rectangle wall = frontWall(scenario);
  addWallFace(scene.mesh, scenario.window.frame_depth_m, true, wall, holes, wallSurface(scenario.house),
              shadowHeight(scenario));
  Rectangle plinth = wall;
  plinth.top_m = plinth.bottom_m + 0.3;
  const double front_m = scenario.window.frame_depth_m - 0.01;
  addWallFace(scene.mesh, front_m, true, plinth, holes, painted({125, 120, 115}, Texture::kPlaster),
              plinth.top_m + 1);
}

void addTarget(const Scenario& scenario, Scene& scene) {
  const WindowParams& window = scenario.window;
  const Rectangle wall = frontWall(scenario), opening = targetOpening(scenario);
  const double depth_m = window.frame_depth_m;
  if (!window.present) {
    scene.obstacles.push_back({"wall", box(depth_m, scene.opening_depth_m, wall)});
    return;
  }
  addFrame(scene.mesh, opening, window.frame_width_m, 0.0, depth_m, painted(window.frame));
  addReveal(scene.mesh, opening, 0.0, scene.opening_depth_m, painted(window.reveal));
  addSolidAround(scene.obstacles, "frame", opening, opening.grown(window.frame_width_m), 0.0, depth_m);
  addSolidAround(scene.obstacles, "wall", opening, wall, depth_m, scene.opening_depth_m);
}

void addDecoy(const Scenario& scenario, const DecoyParams& decoy, Scene& scene) {
  const Rectangle opening = decoyOpening(decoy);
  const double wall_m = scenario.window.frame_depth_m, pane_m = wall_m + kPaneDepth_m;
  const Surface paint = painted(decoy.frame);
  addFrame(scene.mesh, opening, decoy.frame_width_m, 0.0, wall_m, paint);
  addReveal(scene.mesh, opening, 0.0, pane_m, paint);
  const Eigen::Vector3d across(0, opening.left_m - opening.right_m, 0),
      up(0, 0, opening.top_m - opening.bottom_m);
  const Eigen::Vector3d left_bottom(pane_m, opening.left_m, opening.bottom_m);
  const Eigen::Vector3d bright = Eigen::Vector3d::Constant(255.0);
  scene.mesh.addPicture(left_bottom, -across, up, {Texture::kGlass, bright});
  const double bar_m = 0.5 * decoy.frame_width_m;
  const Rectangle bar = Rectangle::around(decoy.y_m, decoy.z_m, bar_m, decoy.height_m);
  scene.mesh.addBox(box(pane_m - 0.03, pane_m, bar), paint);
  scene.obstacles.push_back({"closed window", box(0.0, wall_m, opening.grown(decoy.frame_width_m))});
}

void addPoster(const Scenario& scenario, const PosterParams& poster, Scene& scene) {
  const Rectangle face = Rectangle::around(poster.y_m, poster.z_m, poster.width_m, poster.height_m);
  const double wall_m = scenario.window.frame_depth_m;
  scene.mesh.addBox(box(wall_m - 0.004, wall_m, face), painted(poster.border));
  const Rectangle picture =
      face.grown(-std::min({poster.border_m, 0.4 * poster.width_m, 0.4 * poster.height_m}));
  const Eigen::Vector3d across(0, picture.left_m - picture.right_m, 0),
      up(0, 0, picture.top_m - picture.bottom_m);
  scene.mesh.addPicture({wall_m - 0.008, picture.left_m, picture.bottom_m}, -across, up,
                        {Texture::kPoster, Eigen::Vector3d::Constant(255.0)});
}

void addRoof(const Scenario& scenario, Scene& scene) {
  const Rectangle wall = frontWall(scenario);
  const double depth_m = scene.opening_depth_m + scenario.house.room_depth_m;
  const double side_m = wall.left_m + 0.3, low_m = wall.top_m - 0.02, high_m = low_m + 0.45 * (0.5 * depth_m);
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
  scene.mesh.addBox(box(-kOverhang_m, scenario.window.frame_depth_m, soffit),
                    painted({175, 140, 100}, Texture::kWood));
  const Rectangle roof{-side_m, side_m, low_m - 0.12, high_m};
  scene.obstacles.push_back({"roof", box(-kOverhang_m - 0.08, depth_m + kOverhang_m, roof)});
}

}  // namespace window_ingress::simulation
