/// The scene's quadrilaterals, in the order of the renderer, for the edge smoother to follow their sides.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/surfaces/mesh.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

inline constexpr double kNear_m = 0.03;  ///< nearest drawn distance from the camera

struct Face {
  std::array<Eigen::Vector3d, 4> corners;  ///< window frame [m]
  Eigen::Vector3d normal;                  ///< unit length; points to the side from which the face is visible
  Mesh::Batch batch;
  /// Number of the surface, 1..255: all faces of one plane, texture and colour. Surfaces that are far apart
  /// in the mesh may share a number.
  std::uint8_t surface;
};

/// In the order of the mesh's batches and their vertices.
std::vector<Face> facesOf(const Mesh& mesh);

/// Numbers of the faces that may be visible, near ones first.
std::vector<std::size_t> visibleFaces(const std::vector<Face>& faces, const geometry::PinholeCamera& camera,
                                      const Eigen::Isometry3d& T_camera_window, bool indoors);

}  // namespace window_ingress::simulation
