#pragma once

#include <Eigen/Geometry>

#include "window_ingress/estimation/frames_verdict.hpp"

namespace window_ingress::estimation {

/// Compares the vehicle's attitude from the IMU with that from odometry at the same times. Both must agree
/// about the up direction; heading may differ. Other axes in one of them, such as north-east-down, would give
/// the window a wrong orientation.
class AttitudeCheck {
 public:
  /// \return true if they agree now
  bool see(const Eigen::Matrix3d& R_odom_base_imu, const Eigen::Matrix3d& R_odom_base_odometry);
  void clear() { *this = AttitudeCheck(); }
  /// Undecided until there are enough comparisons, and while only some of them agree.
  FramesVerdict verdict() const { return verdict_; }

 private:
  int in_a_row_ = 0;  ///< successive agreements if positive, else contradictions
  FramesVerdict verdict_{FramesVerdict::kUndecided, "attitude: only one of imu and odometry received so far"};
};

}  // namespace window_ingress::estimation
