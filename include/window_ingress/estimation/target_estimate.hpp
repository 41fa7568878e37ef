#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>

#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/target_motion.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::estimation {

/// The window in the odometry frame, filtered over time.
struct TargetEstimate {
  double stamp_sec = 0.0;                                           ///< of the last image that contributed
  Eigen::Isometry3d T_odom_window = Eigen::Isometry3d::Identity();  ///< upright: yaw and position only
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< odom axes; m, rad
  /// The window's normal is unambiguous. While false, only the bearing of the position may be used.
  bool sign_trusted = false;
  /// Of a window that does not stand still; pose and motion are those of `pose_stamp_sec`, see `ahead`.
  TargetMotion motion;
  double pose_stamp_sec = 0.0;
  int updates = 0;  ///< images that contributed since the window was last acquired
  geometry::OpeningSize opening;
  /// GO: the vehicle fits; UNKNOWN: the size of the opening is still to be found out.
  Fit fit = Fit::kGo;
  /// Why nobody should fly towards the window, whatever its pose: it does not fit or that is not known, or
  /// the camera's mounting or the velocity's frame are not what they are said to be. Empty if there is no
  /// reason.
  std::string approach_forbidden;
  /// What the way flown has yet to show before anybody flies in; empty if nothing.
  std::string unverified;
  /// The way flown has shown that it is not the window looked for, but one so many times as large.
  std::optional<double> other_window;
  /// Whether it is open, by parallax; UNKNOWN until that is seen.
  openness::OpennessVerdict openness;
  std::uint32_t window_id =
      0;  ///< its number in the memory of all windows; 0: not known to be the target yet
};

}  // namespace window_ingress::estimation
