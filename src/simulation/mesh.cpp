#include "window_ingress/simulation/mesh.hpp"

#include <algorithm>

namespace window_ingress::simulation {

double Lighting::operator()(const Eigen::Vector3d& normal) const {
  const double sky = 1.0 + 0.08 * normal.z();
  return ambient * sky + sun * std::max(0.0, normal.dot(towards_sun));
}

void Mesh::add(const std::array<Eigen::Vector3d, 4>& corners, const std::array<Eigen::Vector2d, 4>& uv,
               const Surface& surface) {
  const Eigen::Vector3d normal = (corners[1] - corners[0]).cross(corners[3] - corners[0]).normalized();
  const Eigen::Vector3d lit = lighting_(normal) * surface.colour;
  Vertex vertex;
  for (int c = 0; c < 3; ++c) vertex.colour[c] = static_cast<unsigned char>(std::clamp(lit[c], 0.0, 255.0));
  vertex.colour[3] = 255;
  auto& batch = batches_[{indoors_, surface.texture}];
  for (int i = 0; i < 4; ++i) {
    for (int axis = 0; axis < 3; ++axis) vertex.position[axis] = static_cast<float>(corners[i][axis]);
    vertex.uv = {static_cast<float>(uv[i].x()), static_cast<float>(uv[i].y())};
    batch.push_back(vertex);
  }
}

void Mesh::addQuad(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                   const Surface& surface, const Eigen::Vector2d& uv0_m) {
  const double tile_m = tileSize_m(surface.texture);
  const Eigen::Vector2d a = uv0_m / tile_m, across(u.norm() / tile_m, 0), along(0, v.norm() / tile_m);
  add({origin, origin + u, origin + u + v, origin + v}, {a, a + across, a + across + along, a + along},
      surface);
}

void Mesh::addPicture(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                      const Surface& surface) {
  using Uv = Eigen::Vector2d;
  add({origin, origin + u, origin + u + v, origin + v}, {Uv(0, 1), Uv(1, 1), Uv(1, 0), Uv(0, 0)}, surface);
}

void Mesh::addBox(const Eigen::AlignedBox3d& box, const Surface& surface) {
  const Eigen::Vector3d a = box.min(), b = box.max(), size = box.sizes();
  const Eigen::Vector3d x(size.x(), 0, 0), y(0, size.y(), 0), z(0, 0, size.z());
  addQuad(b - y - z, y, z, surface);  // front x
  addQuad(a + y, -y, z, surface);     // back x
  addQuad(b - z, -x, z, surface);     // left: y
  addQuad(a, x, z, surface);          // right
  addQuad(a + z, x, y, surface);      // top
  addQuad(a + y, x, -y, surface);     // bottom
}

}  // namespace window_ingress::simulation
