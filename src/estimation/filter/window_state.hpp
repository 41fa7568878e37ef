#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "estimation/planar/image_measurement.hpp"
#include "window_ingress/estimation/target_motion.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// State of one belief about the window.
///
/// The window stands upright. Its place is relative to an anchor, the camera's position at the first image,
/// in heights of the opening. The first image then does not depend on the unknown scale at all, and later
/// images depend on the inverse height nearly linearly. A scale known to a factor of two is therefore no
/// problem.
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
    kYawBias,        ///< about its own y axis: mounting alone, without odometry's heading [rad]
    kRollBias,       ///< about its own z axis [rad]
    kLogAspect,      ///< logarithm of width over height of the opening
    kInverseHeight,  ///< of the opening [1/m]
    kHeadingBias,    ///< lasting error of odometry's heading against its positions [rad]
    kLate,           ///< age of odometry relative to the image of the same stamp [s]
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

  /// Derivative of x, y, z [m] and yaw by the values.
  Eigen::Matrix<double, 4, kSize> poseByValues() const;
};

/// a - b, the yaw within (-pi, pi].
WindowState::Vector difference(const WindowState::Vector& a, const WindowState::Vector& b);

/// Pose of a camera. The part `unscaled_m` of its position moves it relative to the window by a fixed number
/// of window heights, whatever their length.
struct ScaledCamera {
  Eigen::Isometry3d T_odom_camera;
  CameraMotion motion;
  Eigen::Vector3d unscaled_m = Eigen::Vector3d::Zero();
};

/// Weighted residuals of an image, with derivatives by the state and by the camera's pose (position in the
/// camera's axes [m], then rotation [rad]).
struct LinearisedView {
  Residual residual;
  ResidualJacobian<WindowState::kSize> by_state;
  ResidualJacobian<6> by_camera;
};

/// Nothing unless the height is positive and all corners lie in front of the camera.
std::optional<LinearisedView> linearise(const ImageMeasurement& image, const geometry::PinholeCamera& camera,
                                        const ScaledCamera& at, const WindowState& state);

}  // namespace window_ingress::estimation
