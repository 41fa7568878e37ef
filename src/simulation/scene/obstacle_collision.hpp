#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace window_ingress::simulation {

/// A solid object in the world: a box along the axes of the window frame.
struct Obstacle {
  std::string name;
  Eigen::AlignedBox3d box;  ///< [m]
};

/// Whether a box with these half extents at the pose `T_window_box` touches the axis-aligned box. Exact:
/// separating axes of both boxes and of their edges.
inline bool touches(const Eigen::Isometry3d& T_window_box, const Eigen::Vector3d& half_extents_m,
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

/// Half extents of the axis-aligned bounding box of a turned box [m].
inline Eigen::Vector3d boundingHalfExtents(const Eigen::Matrix3d& rotation,
                                           const Eigen::Vector3d& half_extents_m) {
  return rotation.cwiseAbs() * half_extents_m;
}

/// Height of the highest top of an obstacle below a point, at least `ground_z_m` [m].
inline double topBelow(const std::vector<Obstacle>& obstacles, const Eigen::Vector3d& point,
                       double ground_z_m) {
  double top_m = ground_z_m;
  for (const Obstacle& obstacle : obstacles) {
    const Eigen::Vector3d low = obstacle.box.min(), high = obstacle.box.max();
    const Eigen::AlignedBox2d base(low.head<2>(), high.head<2>());
    if (base.contains(point.head<2>()) && high.z() <= point.z()) top_m = std::max(top_m, high.z());
  }
  return top_m;
}

}  // namespace window_ingress::simulation
