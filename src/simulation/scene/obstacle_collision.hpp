#pragma once

#include <Eigen/Geometry>
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
bool touches(const Eigen::Isometry3d& T_window_box, const Eigen::Vector3d& half_extents_m,
             const Eigen::AlignedBox3d& box);

/// Half extents of the axis-aligned bounding box of a turned box [m].
Eigen::Vector3d boundingHalfExtents(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& half_extents_m);

/// Height of the highest top of an obstacle below a point, at least `ground_z_m` [m].
double topBelow(const std::vector<Obstacle>& obstacles, const Eigen::Vector3d& point, double ground_z_m);

}  // namespace window_ingress::simulation
