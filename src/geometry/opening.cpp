#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::geometry {

std::array<Eigen::Vector3d, 4> openingCorners(const OpeningSize& size) {
  const double left = 0.5 * size.width_m, up = 0.5 * size.height_m;
  return {Eigen::Vector3d(0, left, up), Eigen::Vector3d(0, -left, up), Eigen::Vector3d(0, -left, -up),
          Eigen::Vector3d(0, left, -up)};
}

std::optional<Quadrilateral> projectOpening(const PinholeCamera& camera, const Eigen::Isometry3d& T_camera_window,
                                            const OpeningSize& size) {
  Quadrilateral image;
  const auto corners = openingCorners(size);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto pixel = camera.project(T_camera_window * corners[i]);
    if (!pixel) return std::nullopt;
    image[i] = *pixel;
  }
  return image;
}

}  // namespace window_ingress::geometry
