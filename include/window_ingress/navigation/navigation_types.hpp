/// What goes into and comes out of the navigator.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/openness/openness_verdict.hpp"
#include "window_ingress/pose/opening_fit.hpp"
#include "window_ingress/pose/target_motion.hpp"

namespace window_ingress::navigation {

/// Odometry of the vehicle.
struct VehicleState {
  double stamp_sec = 0.0;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
};

/// The window in the odometry frame, filtered over time.
struct TargetEstimate {
  double stamp_sec = 0.0;                                           ///< of the last image that contributed
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();  ///< upright: yaw and position only
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< odom axes; m, rad
  /// The window's normal is unambiguous. While false, only the bearing of the position may be used.
  bool sign_trusted = false;
  /// Of a window that does not stand still; pose and motion are those of `pose_stamp_sec`, see `ahead`.
  pose::TargetMotion motion;
  double pose_stamp_sec = 0.0;
  int updates = 0;  ///< images that contributed since the window was last acquired
  geometry::OpeningSize opening;
  /// GO: the vehicle fits; UNKNOWN: the size of the opening is still to be found out.
  pose::Fit fit = pose::Fit::kGo;
  /// Why nobody should fly towards the window, whatever its pose: it does not fit or that is not known, or
  /// the camera's mounting or the velocity's frame are not what they are said to be. Empty if there is no
  /// reason.
  std::string approach_forbidden;
  /// The way flown has shown that it is not the window looked for, but one so many times as large.
  std::optional<double> other_window;
  /// Whether it is open, by parallax; UNKNOWN until that is seen.
  openness::OpennessVerdict openness;
  std::uint32_t window_id =
      0;  ///< its number in the memory of all windows; 0: not known to be the target yet
};

/// Velocity wish for the vehicle: odometry axes, yaw rate about z.
struct Setpoint {
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double yaw_rate_radps = 0.0;
  double heading_error_rad =
      0.0;  ///< of the reported heading, to be taken off it by whoever turns to body axes
};

}  // namespace window_ingress::navigation
