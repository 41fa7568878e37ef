#include <algorithm>
#include <map>

#include "simulation/scene/scene_parts.hpp"

namespace window_ingress::simulation {

Surface painted(const ColourParams& colour, Texture texture) {
  return {texture, Eigen::Vector3d(colour.r, colour.g, colour.b)};
}

Texture wallTexture(const std::string& name) {
  static const std::map<std::string, Texture> textures{{"plaster", Texture::kPlaster},
                                                       {"brick", Texture::kBrick},
                                                       {"siding", Texture::kSiding},
                                                       {"stone", Texture::kStone},
                                                       {"paint", Texture::kPaint}};
  return textures.at(name);
}

Eigen::AlignedBox3d box(double x0, double x1, const Rectangle& face) {
  return {Eigen::Vector3d(x0, face.right_m, face.bottom_m), Eigen::Vector3d(x1, face.left_m, face.top_m)};
}

Eigen::AlignedBox3d pillar(double x_m, double y_m, double half_m, double bottom_m, double top_m) {
  return box(x_m - half_m, x_m + half_m, {y_m - half_m, y_m + half_m, bottom_m, top_m});
}

namespace {

std::vector<double> cuts(double low, double high, std::vector<double> at) {
  at.push_back(low);
  at.push_back(high);
  for (double& value : at) value = std::clamp(value, low, high);
  std::sort(at.begin(), at.end());
  at.erase(std::unique(at.begin(), at.end()), at.end());
  return at;
}

void addCell(Mesh& mesh, double x_m, bool outside, const Rectangle& cell, const Surface& surface) {
  const Eigen::Vector3d corner = cell.corner(x_m), across = cell.across();
  if (outside)
    mesh.addQuad(corner + across, -across, cell.up(), surface, {-cell.left_m, cell.bottom_m});
  else
    mesh.addQuad(corner, across, cell.up(), surface, {cell.right_m, cell.bottom_m});
}

}  // namespace

void addWallFace(Mesh& mesh, double x_m, bool outside, const Rectangle& wall,
                 const std::vector<Rectangle>& holes, const Surface& surface, double shadow_z_m) {
  std::vector<double> y, z{shadow_z_m};
  for (const auto& hole : holes) {
    y.insert(y.end(), {hole.right_m, hole.left_m});
    z.insert(z.end(), {hole.bottom_m, hole.top_m});
  }
  y = cuts(wall.right_m, wall.left_m, y);
  z = cuts(wall.bottom_m, wall.top_m, z);
  const Lighting light = mesh.lighting();
  for (std::size_t i = 0; i + 1 < y.size(); ++i)
    for (std::size_t j = 0; j + 1 < z.size(); ++j) {
      const double y_m = 0.5 * (y[i] + y[i + 1]), z_m = 0.5 * (z[j] + z[j + 1]);
      const auto covers = [&](const Rectangle& hole) { return hole.contains(y_m, z_m); };
      if (std::any_of(holes.begin(), holes.end(), covers)) continue;
      const LitBy lit(z_m > shadow_z_m ? light.inShadow() : light, mesh);
      addCell(mesh, x_m, outside, {y[i], y[i + 1], z[j], z[j + 1]}, surface);
    }
}

void addFrame(Mesh& mesh, const Rectangle& opening, double width_m, double x0, double x1,
              const Surface& surface) {
  const Rectangle outer = opening.grown(width_m);
  addWallFace(mesh, x0, true, outer, {opening}, surface, outer.top_m);
  const Eigen::Vector3d corner = outer.corner(x0), deep(x1 - x0, 0, 0), across = outer.across(),
                        up = outer.up();
  mesh.addQuad(corner, deep, up, surface);           // outer side towards the right
  mesh.addQuad(corner + across, up, deep, surface);  // towards the left
  mesh.addQuad(corner + up, deep, across, surface);  // upwards
  mesh.addQuad(corner, across, deep, surface);       // downwards
}

namespace {

void addInnerFaces(Mesh& mesh, const Rectangle& opening, double x0, double x1, const Surface& surface) {
  const Eigen::Vector3d corner = opening.corner(x0), deep(x1 - x0, 0, 0);
  const Eigen::Vector3d across = opening.across(), up = opening.up();
  mesh.addQuad(corner + deep, -deep, up, surface);   // the right one faces left
  mesh.addQuad(corner + across, deep, up, surface);  // the left one faces right
  mesh.addQuad(corner + up, across, deep, surface);  // the upper one faces down
  mesh.addQuad(corner, deep, across, surface);       // the sill faces up
}

}  // namespace

// A second face lies behind each: where the border of sunlight cuts the first, nothing shines through.
void addReveal(Mesh& mesh, const Rectangle& opening, double x0, double x1, const Surface& surface) {
  constexpr double kBehind_m = 0.002;
  addInnerFaces(mesh, opening, x0, x1, surface);
  const LitBy shadow(mesh.lighting().inShadow(), mesh);
  addInnerFaces(mesh, opening.grown(kBehind_m), x0 + 0.5 * kBehind_m, x1, surface);
}

void addPane(Mesh& mesh, double x_m, const Rectangle& face, const Surface& surface) {
  mesh.addPicture({x_m, face.left_m, face.bottom_m}, -face.across(), face.up(), surface);
}

void addSolidWall(std::vector<Obstacle>& obstacles, const std::string& name, const Rectangle& wall,
                  const std::vector<Rectangle>& holes, double x0, double x1) {
  std::vector<double> y;
  for (const auto& hole : holes) y.insert(y.end(), {hole.right_m, hole.left_m});
  y = cuts(wall.right_m, wall.left_m, y);
  for (std::size_t i = 0; i + 1 < y.size(); ++i) {
    const double y_m = 0.5 * (y[i] + y[i + 1]);
    std::vector<double> ends;
    for (const auto& hole : holes)
      if (y_m > hole.right_m && y_m < hole.left_m) ends.insert(ends.end(), {hole.bottom_m, hole.top_m});
    ends = cuts(wall.bottom_m, wall.top_m, ends);
    for (std::size_t j = 0; j + 1 < ends.size(); ++j) {
      const double z_m = 0.5 * (ends[j] + ends[j + 1]);
      const auto covers = [&](const Rectangle& hole) { return hole.contains(y_m, z_m); };
      if (std::any_of(holes.begin(), holes.end(), covers)) continue;
      obstacles.push_back({name, box(x0, x1, {y[i], y[i + 1], ends[j], ends[j + 1]})});
    }
  }
}

void addSolid(Scene& scene, const std::string& name, const Eigen::AlignedBox3d& solid,
              const Surface& surface) {
  scene.mesh.addBox(solid, surface);
  scene.obstacles.push_back({name, solid});
}

}  // namespace window_ingress::simulation
