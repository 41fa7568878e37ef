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
  /// Motion of a moving window; pose and motion are those at `pose_stamp_sec`, see `ahead`.
  TargetMotion motion;
  double pose_stamp_sec = 0.0;
  geometry::OpeningSize opening;
  /// GO: the vehicle fits; UNKNOWN: the size of the opening is not known yet.
  Fit fit = Fit::kGo;
  /// Why the vehicle must not approach the window, whatever its pose: the vehicle does not fit or this is not
  /// known, or the camera's mounting or the velocity's frame is not as configured. Empty if there is no
  /// reason.
  std::string approach_forbidden;
  /// What the flight must still show before the vehicle may fly in; empty if nothing.
  std::string unverified;
  /// Set if the flight has shown another window than the one looked for: its size over the expected size.
  std::optional<double> other_window;
  /// Whether the window is open, by parallax; UNKNOWN until that is seen.
  openness::OpennessVerdict openness;
  std::uint32_t window_id = 0;  ///< number in the memory of all windows; 0: not yet known as the target
};

/// What the first metres of flight have shown about the frames.
struct FramesVerdict {
  enum State {
    kUndecided,  ///< not enough seen
    kGood,
    kWrong
  };
  State state = kUndecided;
  std::string what;  ///< names the mismatch, or what is still to be seen

  bool operator==(const FramesVerdict& other) const { return state == other.state && what == other.what; }
};

}  // namespace window_ingress::estimation
