/// The scene's quadrilaterals one by one, as the renderer orders them and the edge smoother follows their
/// sides.
#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "simulation/surfaces/mesh.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

inline constexpr double kNear_m = 0.03;  ///< nothing nearer to the camera is drawn

struct Face {
  std::array<Eigen::Vector3d, 4> corners;  ///< window frame [m]
  Eigen::Vector3d normal;                  ///< unit length; the face is seen from where it points to
  Mesh::Batch batch;
  /// 1..255: of its surface, that is of all faces of one plane, texture and colour. Surfaces that many faces
  /// apart in the mesh may share a number.
  std::uint8_t surface;
};

/// In the order of the mesh's batches and of the vertices within them.
std::vector<Face> facesOf(const Mesh& mesh);

/// Numbers of the faces that may be seen, near ones first.
class VisibleFaces {
 public:
  void find(const std::vector<Face>& faces, const geometry::PinholeCamera& camera,
            const Eigen::Isometry3d& T_camera_window, bool indoors);
  const std::vector<std::size_t>& order() const { return order_; }

 private:
  std::vector<std::pair<double, std::size_t>> by_distance_;
  std::vector<std::size_t> order_;
};

}  // namespace window_ingress::simulation
