#include "simulation/scene/obstacle_collision.hpp"

#include <algorithm>

namespace window_ingress::simulation {

Eigen::Vector3d boundingHalfExtents(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& half_extents_m) {
  return rotation.cwiseAbs() * half_extents_m;
}

bool touches(const Eigen::Isometry3d& T_window_box, const Eigen::Vector3d& half_extents_m,
             const Eigen::AlignedBox3d& box) {
  const Eigen::Matrix3d& turned = T_window_box.linear();
  const Eigen::Vector3d between = box.center() - T_window_box.translation();
  const Eigen::Vector3d other_half_m = 0.5 * box.sizes();
  const auto separates = [&](const Eigen::Vector3d& axis) {
    const double reach =
        half_extents_m.dot((turned.transpose() * axis).cwiseAbs()) + other_half_m.dot(axis.cwiseAbs());
    return std::abs(between.dot(axis)) > reach;
  };
  for (int i = 0; i < 3; ++i) {
    if (separates(Eigen::Vector3d::Unit(i)) || separates(turned.col(i))) return false;
    for (int j = 0; j < 3; ++j)
      if (separates(turned.col(i).cross(Eigen::Vector3d::Unit(j)))) return false;
  }
  return true;
}

double topBelow(const std::vector<Obstacle>& obstacles, const Eigen::Vector3d& point, double ground_z_m) {
  double top_m = ground_z_m;
  for (const Obstacle& obstacle : obstacles) {
    const Eigen::Vector3d low = obstacle.box.min(), high = obstacle.box.max();
    const bool under = (point.head<2>().array() >= low.head<2>().array()).all() &&
                       (point.head<2>().array() <= high.head<2>().array()).all();
    if (under && high.z() <= point.z()) top_m = std::max(top_m, high.z());
  }
  return top_m;
}

}  // namespace window_ingress::simulation
