#include "simulation/scene/scene.hpp"

#include <algorithm>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kRoomHalfWidth_m = 2.6, kRoomHeight_m = 2.6, kSideWall_m = 0.2;

constexpr double kDecoyFrameDepth_m = 0.02;
constexpr double kPlinthHeight_m = 0.3, kPlinthDepth_m = 0.01;

Rectangle openingOf(const DecoyParams& decoy) {
  return Rectangle::around(decoy.y_m, decoy.z_m, decoy.width_m, decoy.height_m);
}

// Recesses and holes in the front wall.
std::vector<Rectangle> wallHoles(const Scenario& scenario) {
  std::vector<Rectangle> holes;
  if (scenario.window.present) holes.push_back(targetOpening(scenario));
  for (const auto& decoy : scenario.decoys) holes.push_back(openingOf(decoy));
  for (const auto& door : scenario.doors) holes.push_back(openingOf(scenario, door));
  return holes;
}

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

}  // namespace

Rectangle frontWall(const Scenario& scenario) {
  const double half_m = 0.5 * scenario.house.width_m, ground_m = -scenario.windowCentreHeight();
  return {-half_m, half_m, ground_m, ground_m + scenario.house.eaves_m};
}

Rectangle targetOpening(const Scenario& scenario) {
  return Rectangle::around(0, 0, scenario.window.width_m, scenario.window.height_m);
}

Rectangle openingOf(const Scenario& scenario, const DoorParams& door) {
  const double ground_m = -scenario.windowCentreHeight();
  return {door.y_m - 0.5 * door.width_m, door.y_m + 0.5 * door.width_m, ground_m, ground_m + door.height_m};
}

std::vector<Rectangle> clearHoles(const Scenario& scenario) {
  std::vector<Rectangle> holes;
  if (scenario.window.showsRoom()) holes.push_back(targetOpening(scenario));
  for (const auto& decoy : scenario.decoys)
    if (decoy.showsRoom()) holes.push_back(openingOf(decoy));
  return holes;
}

// The room's walls, wide enough for all openings into the room.
Rectangle roomWalls(const Scenario& scenario) {
  const Rectangle wall = frontWall(scenario);
  const double half_m =
      std::max(std::min(kRoomHalfWidth_m, wall.left_m - kSideWall_m), 0.5 * scenario.window.width_m);
  const double least_top_m = 0.5 * scenario.window.height_m + 0.05;
  Rectangle room{-half_m, half_m, wall.bottom_m, std::max(wall.bottom_m + kRoomHeight_m, least_top_m)};
  for (const auto& hole : clearHoles(scenario)) {
    room.right_m = std::min(room.right_m, hole.right_m - kSideWall_m);
    room.left_m = std::max(room.left_m, hole.left_m + kSideWall_m);
    room.top_m = std::max(room.top_m, hole.top_m + 0.05);
  }
  room.right_m = std::max(room.right_m, wall.right_m);
  room.left_m = std::min(room.left_m, wall.left_m);
  room.top_m = std::min(room.top_m, wall.top_m);
  return room;
}

Rectangle backWindow(const Scenario& scenario) {
  const Rectangle room = roomWalls(scenario);
  const double height_m = std::min(1.3, 0.5 * (room.top_m - room.bottom_m));
  return Rectangle::around(0.15, 0.5 * (room.top_m + room.bottom_m) + 0.15, 1.9, height_m);
}

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

}  // namespace window_ingress::simulation
