#include <algorithm>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kDecoyFrameDepth_m = 0.02;
constexpr double kPlinthHeight_m = 0.3, kPlinthDepth_m = 0.01;

void addPlinth(const Scenario& scenario, const Rectangle& wall, Scene& scene) {
  const WindowParams& window = scenario.window;
  Rectangle plinth = wall;
  const double free_m = window.present ? window.sill_m - window.frame_width_m - 0.01 : kPlinthHeight_m;
  plinth.top_m = plinth.bottom_m + std::min(kPlinthHeight_m, free_m);
  addWallFace(scene.mesh, window.wallFront() - kPlinthDepth_m, true, plinth, wallHoles(scenario),
              painted({125, 120, 115}, Texture::kPlaster), plinth.top_m + 1);
}

Texture printOf(const PosterParams& poster) {
  if (poster.look == "window") return Texture::kPrintedWindow;
  return poster.look == "chessboard" ? Texture::kChessboard : Texture::kPoster;
}

}  // namespace

void addFront(const Scenario& scenario, Scene& scene) {
  const Rectangle wall = frontWall(scenario);
  const double front_m = scenario.window.wallFront();
  const Surface surface = painted(scenario.house.wall, wallTexture(scenario.house.wall_texture));
  addWallFace(scene.mesh, front_m, true, wall, wallHoles(scenario), surface, eavesShadow(scenario, front_m));
  addPlinth(scenario, wall, scene);
  std::vector<Rectangle> holes = clearHoles(scenario);
  if (scenario.window.present && !scenario.window.showsRoom()) holes.push_back(targetOpening(scenario));
  addSolidWall(scene.obstacles, "wall", wall, holes, front_m, scene.opening_depth_m);
}

void addTarget(const Scenario& scenario, Scene& scene) {
  const WindowParams& window = scenario.window;
  if (!window.present) return;
  const bool bare = window.frame_width_m <= 0.0;
  const Texture inner = bare ? wallTexture(scenario.house.wall_texture) : Texture::kPlain;
  addFitting(scenario,
             {targetOpening(scenario), window.frame_width_m, 0.0, painted(window.frame),
              painted(window.reveal, inner), window.surround, window.closed_by, window.bars, "frame",
              window.closed_by, window.dirt},
             scene);
}

void addDecoy(const Scenario& scenario, const DecoyParams& decoy, Scene& scene) {
  const double front_m = std::min(0.0, scenario.window.wallFront() - kDecoyFrameDepth_m);
  const Surface paint = painted(decoy.frame);
  addFitting(scenario,
             {openingOf(decoy), decoy.frame_width_m, front_m, paint, paint, decoy.surround, decoy.closed_by,
              decoy.bars, "frame of another window", "closed window", 0.0},
             scene);
}

void addPoster(const Scenario& scenario, const PosterParams& poster, Scene& scene) {
  const Rectangle face = Rectangle::around(poster.y_m, poster.z_m, poster.width_m, poster.height_m);
  const double wall_m = scenario.window.wallFront();
  scene.mesh.addBox(box(wall_m - 0.004, wall_m, face), painted(poster.border));
  const Rectangle picture =
      face.grown(-std::min({poster.border_m, 0.4 * poster.width_m, 0.4 * poster.height_m}));
  addPane(scene.mesh, wall_m - 0.008, picture, {printOf(poster), Eigen::Vector3d::Constant(255.0)});
}

}  // namespace window_ingress::simulation
