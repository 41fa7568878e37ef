#pragma once

#include <Eigen/Geometry>

#include "window_ingress/estimation/frames_verdict.hpp"

namespace window_ingress::estimation {

/// Compares two attitudes of the vehicle at the same moments, that of its IMU and that of its odometry: they
/// must agree about where up is (heading may differ). One of them in other axes, say north-east-down, would
/// turn the window about.
class AttitudeCheck {
 public:
  /// \return whether they agree now
  bool see(const Eigen::Matrix3d& R_odom_base_imu, const Eigen::Matrix3d& R_odom_base_odometry);
  void clear() { *this = AttitudeCheck(); }
  /// Open until enough was seen, and while they sometimes agree.
  FramesVerdict verdict() const { return verdict_; }

 private:
  int in_a_row_ = 0;  ///< agreeing if positive
  FramesVerdict verdict_{FramesVerdict::kOpen, "attitude: only one of imu and odometry so far"};
};

}  // namespace window_ingress::estimation
