#include "simulation/surfaces/mesh.hpp"

#include <algorithm>
#include <utility>

namespace window_ingress::simulation {
namespace {

constexpr double kOnPlane_m = 1e-9;

Eigen::Vector3d normalOf(const Polygon& polygon) {
  const Eigen::Vector3d& origin = polygon[0].position;
  return (polygon[1].position - origin).cross(polygon[3].position - origin).normalized();
}

Eigen::Vector3d middleOf(const Polygon& polygon) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& corner : polygon) sum += corner.position;
  return sum / static_cast<double>(polygon.size());
}

// The parts of a convex polygon inside and outside a half space; either may be empty. Points within
// kOnPlane_m of the plane belong to both.
std::pair<Polygon, Polygon> split(const Polygon& polygon, const HalfSpace& half_space) {
  Polygon within, beyond;
  bool any_within = false, any_beyond = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = half_space.beyond(a.position), at_b = half_space.beyond(b.position);
    any_within = any_within || at_a < -kOnPlane_m;
    any_beyond = any_beyond || at_a > kOnPlane_m;
    if (at_a <= kOnPlane_m) within.push_back(a);
    if (at_a >= -kOnPlane_m) beyond.push_back(a);
    const bool crosses = std::min(at_a, at_b) < -kOnPlane_m && std::max(at_a, at_b) > kOnPlane_m;
    if (!crosses) continue;
    const double part = at_a / (at_a - at_b);
    const Corner cut{a.position + part * (b.position - a.position), a.uv + part * (b.uv - a.uv)};
    within.push_back(cut);
    beyond.push_back(cut);
  }
  if (any_beyond && !any_within) within.clear();
  if (!any_beyond) beyond.clear();
  return {within, beyond};
}

// Every plane cuts every part, so that neighbouring parts share their corners.
std::vector<Polygon> cutBy(const std::vector<HalfSpace>& planes, const Polygon& polygon) {
  std::vector<Polygon> parts{polygon};
  for (const auto& plane : planes) {
    std::vector<Polygon> finer;
    for (const auto& part : parts) {
      auto [within, beyond] = split(part, plane);
      if (!within.empty()) finer.push_back(std::move(within));
      if (!beyond.empty()) finer.push_back(std::move(beyond));
    }
    parts = std::move(finer);
  }
  return parts;
}

}  // namespace

void Mesh::addPolygon(const Polygon& polygon, const Surface& surface) {
  const Eigen::Vector3d normal = normalOf(polygon);
  if (!lighting_.reaches(normal) || lighting_.region.empty())
    return emit(polygon, surface, lighting_.brightness(normal, true));
  for (const Polygon& part : cutBy(lighting_.region, polygon))
    emit(part, surface, lighting_.brightness(normal, lighting_.sunlit(middleOf(part))));
}

void Mesh::emit(const Polygon& polygon, const Surface& surface, const Eigen::Vector3d& brightness) {
  const Eigen::Vector3d lit = brightness.cwiseProduct(surface.colour);
  Vertex vertex;
  for (int c = 0; c < 3; ++c) vertex.colour[c] = static_cast<unsigned char>(std::clamp(lit[c], 0.0, 255.0));
  vertex.colour[3] = 255;
  auto& batch = batches_[{indoors_, surface.texture}];
  const auto push = [&](std::size_t i) {
    const Corner& corner = polygon[std::min(i, polygon.size() - 1)];
    for (int axis = 0; axis < 3; ++axis) vertex.position[axis] = static_cast<float>(corner.position[axis]);
    vertex.uv = {static_cast<float>(corner.uv.x()), static_cast<float>(corner.uv.y())};
    batch.push_back(vertex);
  };
  for (std::size_t i = 1; i + 1 < polygon.size(); i += 2)
    for (const std::size_t corner : {std::size_t{0}, i, i + 1, i + 2}) push(corner);
}

void Mesh::addQuad(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                   const Surface& surface, const Eigen::Vector2d& uv0_m) {
  const double tile_m = tileSize_m(surface.texture);
  const Eigen::Vector2d a = uv0_m / tile_m, across(u.norm() / tile_m, 0), along(0, v.norm() / tile_m);
  addPolygon(
      {{origin, a}, {origin + u, a + across}, {origin + u + v, a + across + along}, {origin + v, a + along}},
      surface);
}

void Mesh::addPicture(const Eigen::Vector3d& origin, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                      const Surface& surface) {
  addPolygon({{origin, {0, 1}}, {origin + u, {1, 1}}, {origin + u + v, {1, 0}}, {origin + v, {0, 0}}},
             surface);
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
