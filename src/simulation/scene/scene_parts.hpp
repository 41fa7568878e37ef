/// Parts from which `buildScene` makes a world. All coordinates are in the target's window frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "simulation/scene/scene.hpp"

namespace window_ingress::simulation {

/// An upright rectangle in a plane of constant x [m].
struct Rectangle {
  double right_m, left_m, bottom_m, top_m;  // y from right to left, z from bottom to top
  static Rectangle around(double y_m, double z_m, double width_m, double height_m) {
    return {y_m - 0.5 * width_m, y_m + 0.5 * width_m, z_m - 0.5 * height_m, z_m + 0.5 * height_m};
  }
  Rectangle grown(double by_m) const {
    return {right_m - by_m, left_m + by_m, bottom_m - by_m, top_m + by_m};
  }
  bool contains(double y_m, double z_m) const {
    return y_m > right_m && y_m < left_m && z_m > bottom_m && z_m < top_m;
  }
  Eigen::Vector3d across() const { return {0, left_m - right_m, 0}; }
  Eigen::Vector3d up() const { return {0, 0, top_m - bottom_m}; }
  Eigen::Vector3d corner(double x_m) const { return {x_m, right_m, bottom_m}; }  ///< the lower right one
};

/// A window in the front wall, the target or another one.
struct Fitting {
  Rectangle opening;
  double frame_width_m, frame_front_m;  // the frame extends from frame_front_m to the wall
  Surface frame, reveal;
  std::string surround, closed_by, bars;
  std::string frame_name, closed_name;  // names in a report of a contact
  double dirt;                          // part of its glass that is covered by dirt
};

Surface painted(const ColourParams& colour, Texture texture = Texture::kPlain);
/// The texture for a wall, by its name in a scenario.
Texture wallTexture(const std::string& name);
Eigen::AlignedBox3d box(double x0, double x1, const Rectangle& face);
/// A box with a square section around `x_m`, `y_m`.
Eigen::AlignedBox3d pillar(double x_m, double y_m, double half_m, double bottom_m, double top_m);

// --- light (scene_light.cpp)
Lighting daylight(const Scenario& scenario);
Lighting roomLight(const Scenario& scenario);
Lighting skyLight(const Scenario& scenario);
std::optional<Fog> fogOf(const Scenario& scenario);
/// Height of the lower border of the eaves' shadow on an upright plane.
double eavesShadow(const Scenario& scenario, double x_m);
/// Daylight on the inner faces of an opening with its front at `x_m`.
Lighting revealLight(const Scenario& scenario, const Rectangle& opening, double x_m);

// --- walls (scene_walls.cpp)
/// The face of a wall at `x_m`, towards the outside or the room, with holes. The face is cut along the lines
/// of all holes, so that no vertex lies on another's side (no cracks). Parts above `shadow_z_m` get no sun.
void addWallFace(Mesh& mesh, double x_m, bool outside, const Rectangle& wall,
                 const std::vector<Rectangle>& holes, const Surface& surface, double shadow_z_m);
/// Four bars around an opening from x0 to x1, without inner faces.
void addFrame(Mesh& mesh, const Rectangle& opening, double width_m, double x0, double x1,
              const Surface& surface);
/// The inner faces of an opening from x0 to x1.
void addReveal(Mesh& mesh, const Rectangle& opening, double x0, double x1, const Surface& surface);
/// An image over a rectangle, towards the outside.
void addPane(Mesh& mesh, double x_m, const Rectangle& face, const Surface& surface);
/// The solid parts of a wall between x0 and x1.
void addSolidWall(std::vector<Obstacle>& obstacles, const std::string& name, const Rectangle& wall,
                  const std::vector<Rectangle>& holes, double x0, double x1);
void addSolid(Scene& scene, const std::string& name, const Eigen::AlignedBox3d& solid,
              const Surface& surface);

// --- what stands where (scene.cpp)
constexpr double kOverhang_m = 0.45;  // of the roof
/// The roof as an obstacle.
Eigen::AlignedBox3d roofBox(const Scenario& scenario);
Rectangle frontWall(const Scenario& scenario);
Rectangle roomWalls(const Scenario& scenario);
Rectangle backWindow(const Scenario& scenario);
Rectangle targetOpening(const Scenario& scenario);
Rectangle openingOf(const Scenario& scenario, const DoorParams& door);
/// Holes through which the room is visible: the target and other windows, if open or of clear glass.
std::vector<Rectangle> clearHoles(const Scenario& scenario);

// --- the parts
void addFitting(const Scenario& scenario, const Fitting& fitting, Scene& scene);
void addDoor(const Scenario& scenario, const DoorParams& door, Scene& scene);
void addRoof(const Scenario& scenario, Scene& scene);
void addGarden(Scene& scene);
void addSky(const Scenario& scenario, Scene& scene);
void addRoom(const Scenario& scenario, Scene& scene);

}  // namespace window_ingress::simulation
