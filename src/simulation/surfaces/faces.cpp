#include "simulation/surfaces/faces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace window_ingress::simulation {
namespace {

constexpr double kPlaneTolerance = 1e-4;

// Faces with equal keys belong to one surface.
using SurfaceKey = std::tuple<bool, Texture, std::array<unsigned char, 4>, std::array<long, 4>>;

SurfaceKey keyOf(const Face& face, const std::array<unsigned char, 4>& colour) {
  std::array<long, 4> plane;
  for (int axis = 0; axis < 3; ++axis) plane[axis] = std::lround(face.normal[axis] / kPlaneTolerance);
  plane[3] = std::lround(face.normal.dot(face.corners[0]) / kPlaneTolerance);
  return {face.batch.indoors, face.batch.texture, colour, plane};
}

Face faceOf(const Mesh::Batch& batch, const Vertex* vertices) {
  Face face;
  face.batch = batch;
  for (int i = 0; i < 4; ++i) {
    const auto& p = vertices[i].position;
    face.corners[i] = Eigen::Vector3d(p[0], p[1], p[2]);
  }
  const Eigen::Vector3d across = face.corners[2] - face.corners[0], up = face.corners[3] - face.corners[1];
  face.normal = across.cross(up).normalized();
  return face;
}

// The planes through the image's borders (half a pixel outside the outermost centres), pointing inwards.
std::array<Eigen::Vector3d, 5> frustum(const geometry::PinholeCamera& camera) {
  const double left = (-1.0 - camera.cx) / camera.fx, right = (camera.width - camera.cx) / camera.fx;
  const double top = (-1.0 - camera.cy) / camera.fy, bottom = (camera.height - camera.cy) / camera.fy;
  return {Eigen::Vector3d(1, 0, -left), Eigen::Vector3d(-1, 0, right), Eigen::Vector3d(0, 1, -top),
          Eigen::Vector3d(0, -1, bottom), Eigen::Vector3d::UnitZ()};
}

}  // namespace

std::vector<Face> facesOf(const Mesh& mesh) {
  std::vector<Face> faces;
  std::map<SurfaceKey, std::size_t> surfaces;
  for (const auto& [batch, vertices] : mesh.batches())
    for (std::size_t first = 0; first + 4 <= vertices.size(); first += 4) {
      Face face = faceOf(batch, &vertices[first]);
      const auto known = surfaces.emplace(keyOf(face, vertices[first].colour), surfaces.size()).first;
      face.surface = static_cast<std::uint8_t>(known->second % 255 + 1);
      faces.push_back(face);
    }
  return faces;
}

std::vector<std::size_t> visibleFaces(const std::vector<Face>& faces, const geometry::PinholeCamera& camera,
                                      const Eigen::Isometry3d& T_camera_window, bool indoors) {
  const Eigen::Vector3d eye = T_camera_window.inverse().translation();
  const auto planes = frustum(camera);
  std::vector<std::pair<double, std::size_t>> by_distance;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Face& face = faces[i];
    if ((face.batch.indoors && !indoors) || face.normal.dot(eye - face.corners[0]) <= 0.0) continue;
    std::array<Eigen::Vector3d, 4> corners;
    double farthest = 0.0;
    for (int k = 0; k < 4; ++k) {
      corners[k] = T_camera_window * face.corners[k];
      farthest = std::max(farthest, corners[k].squaredNorm());
    }
    const bool outside = std::any_of(planes.begin(), planes.end(), [&](const Eigen::Vector3d& plane) {
      return std::all_of(corners.begin(), corners.end(),
                         [&](const Eigen::Vector3d& corner) { return plane.dot(corner) < 0.0; });
    });
    if (!outside) by_distance.emplace_back(farthest, i);
  }
  std::sort(by_distance.begin(), by_distance.end());
  std::vector<std::size_t> order;
  for (const auto& [distance, i] : by_distance) order.push_back(i);
  return order;
}

}  // namespace window_ingress::simulation
