#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::facade {

/// Where a window is in the odometry frame, and how large it is.
struct WindowPlace {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();      ///< of the opening's centre
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of it [m^2]
  double heading_rad = 0.0;                                  ///< of the way through, about z
  geometry::OpeningSize size;
  bool on_wall = false;  ///< heading, size and distance were measured; else they are those assumed
};

/// The wall in which a window was found: its neighbours lie in it, too.
struct Wall {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< a point of it, in odom
  double heading_rad = 0.0;                              ///< of the way through
  double sigma_m = 0.0;  ///< standard deviation along the way through, at the point
  double heading_sigma_rad = 0.0;
};

constexpr double kWallSigmaM = 0.15;  ///< how far windows lie before or behind the plane of the target

/// From where an image was taken.
struct Viewpoint {
  geometry::PinholeCamera camera;
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
};

/// A window seen at `corners`: where the lines of sight meet the wall; without a wall, or where it is seen
/// too obliquely, as far away as a window of the size looked for would be, which is little known. \param
/// corners in pixels of the image as it came \return nothing if it is behind, or too far
std::optional<WindowPlace> placeOf(const geometry::Quadrilateral& corners, const Viewpoint& view,
                                   const std::optional<Wall>& wall, const geometry::OpeningSize& looked_for);

/// T_odom_window of an upright window.
Eigen::Isometry3d poseOf(const WindowPlace& place);

/// Where it is in the image, as that comes (distorted); nothing if it is not wholly in view.
std::optional<geometry::Quadrilateral> inView(const WindowPlace& place, const Viewpoint& view);

/// Squared distance of two places in standard deviations, of three degrees of freedom.
/// \param drift_m2 variance that the odometry has gathered in between [m^2]
double squaresBetween(const WindowPlace& a, const WindowPlace& b, double drift_m2);

/// The better of what both say, though it is not known how far their errors are the same: covariance
/// intersection (Julier and Uhlmann 1997).
WindowPlace fused(const WindowPlace& a, const WindowPlace& b);

}  // namespace window_ingress::facade
