#include <algorithm>
#include <cmath>
#include <map>

#include "simulation/random_stream.hpp"
#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {
namespace {

using Eigen::Vector3d;

constexpr double kPaneDepth_m = 0.07, kShutterDepth_m = 0.015;

struct Closure {
  Texture texture;
  ColourParams colour;
  double depth_m;  // behind the wall's face
  bool stretched;  // over the whole opening
};

const Closure& closureOf(const std::string& closed_by) {
  static const std::map<std::string, Closure> closures{
      {"glass", {Texture::kPlain, {170, 165, 155}, kPaneDepth_m, true}},  // colour of its dirt
      {"tinted_glass", {Texture::kGlass, {255, 255, 255}, kPaneDepth_m, true}},
      {"curtain", {Texture::kCurtain, {214, 206, 190}, kPaneDepth_m, true}},
      {"blinds", {Texture::kLouvres, {222, 222, 216}, kPaneDepth_m, false}},
      {"shutter", {Texture::kLouvres, {122, 104, 82}, kShutterDepth_m, false}},
      {"board", {Texture::kWood, {214, 182, 138}, kShutterDepth_m, false}}};
  return closures.at(closed_by);
}

double paneFront(const Scenario& scenario, const std::string& closed_by) {
  const double depth_m = std::min(closureOf(closed_by).depth_m, 0.5 * scenario.house.wall_thickness_m);
  return scenario.window.wallFront() + depth_m;
}

void addBars(const Fitting& fitting, double pane_m, Mesh& mesh) {
  const Rectangle& opening = fitting.opening;
  const double half_m = std::max(0.015, 0.25 * fitting.frame_width_m);
  const double y_m = 0.5 * (opening.right_m + opening.left_m), z_m = 0.5 * (opening.bottom_m + opening.top_m);
  if (fitting.bars == "none") return;
  mesh.addBox(box(pane_m - 0.03, pane_m, {y_m - half_m, y_m + half_m, opening.bottom_m, opening.top_m}),
              fitting.frame);
  if (fitting.bars != "cross") return;
  for (const auto& [right_m, left_m] :
       {std::pair(opening.right_m, y_m - half_m), {y_m + half_m, opening.left_m}})
    mesh.addBox(box(pane_m - 0.03, pane_m, {right_m, left_m, z_m - half_m, z_m + half_m}), fitting.frame);
}

// A clear pane shows only its dirt and its reflection.
void addClearPane(const Fitting& fitting, double pane_m, const Surface& dirt, Scene& scene) {
  constexpr double kBefore_m = 0.001, kMin_m = 0.004, kMax_m = 0.03;
  const Rectangle& face = fitting.opening;
  const double width_m = face.left_m - face.right_m, height_m = face.top_m - face.bottom_m;
  scene.panes.push_back(
      {pane_m, {Eigen::Vector2d(face.right_m, face.bottom_m), Eigen::Vector2d(face.left_m, face.top_m)}});
  RandomStream random(scene.texture_seed, "dirt");
  for (double left_m2 = fitting.dirt * width_m * height_m; left_m2 > 0.0;) {
    const double size_m = kMin_m * std::pow(kMax_m / kMin_m, random.uniform(0.0, 1.0));
    const double y_m = face.left_m - random.uniform(0.0, width_m - size_m);
    const double z_m = face.bottom_m + random.uniform(0.0, height_m - size_m);
    scene.mesh.addQuad({pane_m - kBefore_m, y_m, z_m}, {0, -size_m, 0}, {0, 0, size_m}, dirt);
    left_m2 -= size_m * size_m;
  }
}

void addClosure(const Fitting& fitting, double pane_m, Scene& scene) {
  const Closure& closure = closureOf(fitting.closed_by);
  const Rectangle& opening = fitting.opening;
  const Surface surface = painted(closure.colour, closure.texture);
  if (fitting.closed_by == "glass")
    addClearPane(fitting, pane_m, surface, scene);
  else if (closure.stretched)
    addPane(scene.mesh, pane_m, opening, surface);
  else
    addWallFace(scene.mesh, pane_m, true, opening, {}, surface, opening.top_m);
  addBars(fitting, pane_m, scene.mesh);
  scene.obstacles.push_back({fitting.closed_name, box(pane_m, scene.opening_depth_m, opening)});
}

// The strips of wall in the shadow of a frame.
void addFrameShadow(const Scenario& scenario, const Rectangle& outer, double front_m, Mesh& mesh) {
  constexpr double kBefore_m = 0.0008, kMax_m = 0.12;
  const Lighting& light = mesh.lighting();
  const Vector3d sun = light.towards_sun;
  const double wall_m = scenario.window.wallFront(), depth_m = wall_m - front_m;
  if (light.sun <= 0.0 || sun.x() > -0.1 || depth_m < 0.01) return;
  const Surface surface = painted(scenario.house.wall, wallTexture(scenario.house.wall_texture));
  const double tile_m = tileSize_m(surface.texture), x_m = wall_m - kBefore_m;
  const Vector3d slide(0, std::clamp(sun.y() / sun.x() * depth_m, -kMax_m, kMax_m),
                       std::clamp(sun.z() / sun.x() * depth_m, -kMax_m, 0.0));
  const auto strip = [&](const Vector3d& from, const Vector3d& along) {
    Polygon polygon;
    for (const Vector3d& p :
         {from, Vector3d(from + slide), Vector3d(from + slide + along), Vector3d(from + along)})
      polygon.push_back({p, {-p.y() / tile_m, p.z() / tile_m}});
    if (along.cross(slide).x() < 0.0) std::reverse(polygon.begin(), polygon.end());
    mesh.addPolygon(polygon, surface);
  };
  const LitBy shadow(light.inShadow(), mesh);
  const double side_m = slide.y() > 0.0 ? outer.left_m : outer.right_m;
  strip({x_m, side_m, outer.bottom_m}, {0, 0, outer.top_m - outer.bottom_m});
  strip({x_m, outer.right_m, outer.bottom_m}, {0, outer.left_m - outer.right_m, 0});
}

void addSurround(const Scenario& scenario, const Fitting& fitting, const Rectangle& outer, Scene& scene) {
  const double wall_m = scenario.window.wallFront();
  const Surface stone = painted({188, 184, 176}, Texture::kPlaster);
  const auto add = [&](const std::string& name, double depth_m, const Rectangle& face,
                       const Surface& surface) {
    addSolid(scene, name, box(wall_m - depth_m, wall_m, face), surface);
  };
  if (fitting.surround == "sill")
    add("sill", 0.09, {outer.right_m - 0.06, outer.left_m + 0.06, outer.bottom_m - 0.05, outer.bottom_m},
        stone);
  if (fitting.surround == "lintel")
    add("lintel", 0.03, {outer.right_m - 0.12, outer.left_m + 0.12, outer.top_m, outer.top_m + 0.16}, stone);
  if (fitting.surround != "shutters") return;
  const double wide_m = 0.5 * (outer.left_m - outer.right_m);
  const Surface leaf = painted({84, 112, 96}, Texture::kLouvres);
  for (const double right_m : {outer.right_m - 0.02 - wide_m, outer.left_m + 0.02})
    add("shutter", 0.04, {right_m, right_m + wide_m, outer.bottom_m, outer.top_m}, leaf);
}

}  // namespace

void addFitting(const Scenario& scenario, const Fitting& fitting, Scene& scene) {
  const double wall_m = scenario.window.wallFront();
  const bool framed = fitting.frame_width_m > 0.0, closed = fitting.closed_by != "none";
  const double front_m = framed ? fitting.frame_front_m : wall_m;
  const Rectangle outer = fitting.opening.grown(fitting.frame_width_m);
  if (framed) {
    addFrame(scene.mesh, fitting.opening, fitting.frame_width_m, front_m, wall_m, fitting.frame);
    addSolidWall(scene.obstacles, fitting.frame_name, outer, {fitting.opening}, front_m, wall_m);
    addFrameShadow(scenario, outer, front_m, scene.mesh);
  }
  const double pane_m = closed ? paneFront(scenario, fitting.closed_by) : scene.opening_depth_m;
  const double end_m = fitting.closed_by == "glass" ? scene.opening_depth_m : pane_m;
  {
    const LitBy light(revealLight(scenario, fitting.opening, front_m), scene.mesh);
    addReveal(scene.mesh, fitting.opening, front_m, end_m, fitting.reveal);
    if (closed) addClosure(fitting, pane_m, scene);
  }
  addSurround(scenario, fitting, outer, scene);
}

void addDoor(const Scenario& scenario, const DoorParams& door, Scene& scene) {
  const Rectangle opening = openingOf(scenario, door);
  const double wall_m = scenario.window.wallFront(), leaf_m = wall_m + 0.05, front_m = wall_m - 0.02;
  const Surface frame = painted(door.frame), leaf = painted(door.leaf);
  addFrame(scene.mesh, opening, door.frame_width_m, front_m, wall_m, frame);
  addFrameShadow(scenario, opening.grown(door.frame_width_m), front_m, scene.mesh);
  const LitBy light(revealLight(scenario, opening, front_m), scene.mesh);
  addReveal(scene.mesh, opening, front_m, leaf_m, frame);
  addWallFace(scene.mesh, leaf_m, true, opening, {}, leaf, opening.top_m);
  const double bottom_m = opening.bottom_m, middle_m = bottom_m + 0.5 * door.height_m, inset_m = 0.14;
  const Rectangle lower{opening.right_m + inset_m, opening.left_m - inset_m, bottom_m + 0.2, middle_m - 0.08};
  const Rectangle upper{lower.right_m, lower.left_m, middle_m + 0.08, opening.top_m - inset_m};
  for (const Rectangle& panel : {lower, upper}) scene.mesh.addBox(box(leaf_m - 0.012, leaf_m, panel), leaf);
  if (door.glazed)
    addPane(scene.mesh, leaf_m - 0.014, upper.grown(-0.03), painted({255, 255, 255}, Texture::kGlass));
  scene.mesh.addBox(box(leaf_m - 0.06, leaf_m - 0.03,
                        {opening.right_m + 0.05, opening.right_m + 0.17, middle_m - 0.02, middle_m + 0.01}),
                    painted({205, 205, 210}));
  scene.obstacles.push_back({"door", box(front_m, wall_m, opening.grown(door.frame_width_m))});
}

}  // namespace window_ingress::simulation
