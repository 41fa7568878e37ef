#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::facade {

/// Pose and size of a window in the odometry frame.
struct WindowPlace {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();      ///< of the opening's centre
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Identity();  ///< of the position [m^2]
  double heading_rad = 0.0;                                  ///< direction of flight through it, about z
  geometry::OpeningSize size;
  bool on_wall = false;  ///< heading, size and distance are measured, not assumed
};

/// The wall in which a window was found; its neighbours lie in it, too.
struct Wall {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();  ///< a point on the wall, in odom
  double heading_rad = 0.0;                              ///< of the way through
  double sigma_m = 0.0;  ///< standard deviation along its normal, at the point
  double heading_sigma_rad = 0.0;
};

constexpr double kWallSigmaM = 0.15;  ///< spread of windows in front of or behind the plane of the target

/// Viewpoint of an image.
struct Viewpoint {
  geometry::PinholeCamera camera;
  Eigen::Isometry3d T_odom_camera = Eigen::Isometry3d::Identity();
};

/// Place of a window seen at `corners`: where the lines of sight meet the wall. Without a wall, or if it is
/// seen too obliquely, the distance is that of a window of the size looked for, with a large uncertainty.
/// \param corners distorted pixels
/// \return nothing if the window is behind the camera or too far away
std::optional<WindowPlace> placeOf(const geometry::Quadrilateral& corners, const Viewpoint& view,
                                   const std::optional<Wall>& wall, const geometry::OpeningSize& looked_for);

/// T_odom_window of an upright window.
Eigen::Isometry3d poseOf(const WindowPlace& place);

/// Its place in the image (distorted pixels); nothing if it is not wholly in view.
std::optional<geometry::Quadrilateral> inView(const WindowPlace& place, const Viewpoint& view);

/// Squared Mahalanobis distance of two places, three degrees of freedom.
/// \param drift_m2 variance that odometry has accumulated in between [m^2]
double squaresBetween(const WindowPlace& a, const WindowPlace& b, double drift_m2);

/// Fusion of two places whose errors may be correlated: covariance intersection (Julier and Uhlmann 1997).
WindowPlace fused(const WindowPlace& a, const WindowPlace& b);

}  // namespace window_ingress::facade
