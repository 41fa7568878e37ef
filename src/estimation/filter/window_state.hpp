#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "estimation/planar/image_measurement.hpp"
#include "window_ingress/estimation/camera_motion.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// What one belief about the window consists of.
///
/// The window stands upright. Its place is counted from an anchor, the camera's position at the first image,
/// in heights of the opening: what that image shows does not depend on the unknown scale at all, and later
/// images depend on the inverse height nearly linearly, so that a scale known to a factor of two is no
/// trouble.
struct WindowState {
  static constexpr int kSize = 14;
  using Vector = Eigen::Matrix<double, kSize, 1>;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  enum Index {
    kX,  ///< of the window's origin from the anchor, odom axes [heights of the opening]
    kY,
    kZ,
    kYaw,            ///< about odom's z [rad]
    kPitchBias,      ///< lasting error of the camera's attitude about its own x axis [rad]
    kYawBias,        ///< about its own y axis: mounting alone, odometry's heading is free [rad]
    kRollBias,       ///< about its own z axis [rad]
    kLogAspect,      ///< logarithm of width over height of the opening
    kInverseHeight,  ///< of the opening [1/m]
    kHeadingBias,    ///< lasting error of odometry's heading beside its positions [rad]
    kLate,           ///< how much older than the image odometry of the same stamp is [s]
    kVelocityX,      ///< of the window, odom axes [heights of the opening per second]
    kVelocityY,
    kVelocityZ,
  };

  Vector values = Vector::Zero();
  Eigen::Vector3d anchor_m = Eigen::Vector3d::Zero();

  double heightM() const { return 1.0 / values(kInverseHeight); }
  double yaw() const { return values(kYaw); }
  Eigen::Vector3d position() const { return anchor_m + heightM() * values.head<3>(); }
  Eigen::Vector3d velocity() const { return heightM() * values.segment<3>(kVelocityX); }
  geometry::OpeningSize opening() const { return {std::exp(values(kLogAspect)) * heightM(), heightM()}; }
  Eigen::Isometry3d T_odom_window() const;
  Eigen::Isometry3d T_camera_window(const Eigen::Isometry3d& T_odom_camera) const;

  /// How x, y, z [m] and yaw move with the values.
  Eigen::Matrix<double, 4, kSize> poseByValues() const;
};

/// a - b, the yaw within (-pi, pi].
WindowState::Vector difference(const WindowState::Vector& a, const WindowState::Vector& b);

/// Where a camera is. The share of its position that does not scale with the window moves it relative to the
/// window by a fixed number of the window's heights, whatever their length.
struct ScaledCamera {
  Eigen::Isometry3d T_odom_camera;
  CameraMotion motion;
  Eigen::Vector3d unscaled_m = Eigen::Vector3d::Zero();
};

/// Weighted residuals of an image, and how they move with the state and with the camera's pose (position in
/// the camera's axes [m], then rotation [rad]).
struct LinearisedView {
  Residual residual;
  ResidualJacobian<WindowState::kSize> by_state;
  ResidualJacobian<6> by_camera;
};

/// Nothing unless the height is positive and all corners lie in front of the camera.
std::optional<LinearisedView> linearise(const ImageMeasurement& image, const geometry::PinholeCamera& camera,
                                        const ScaledCamera& at, const WindowState& state);

}  // namespace window_ingress::estimation
