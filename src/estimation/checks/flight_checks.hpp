#pragma once

#include "estimation/checks/mounting_check.hpp"
#include "estimation/checks/parallax_check.hpp"
#include "estimation/checks/twist_check.hpp"

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

/// Verifies camera mounting, attitude, velocity frame and the opening's size in the first metres of motion,
/// by predictions of what is seen and flown. A mismatch is named; do not fly towards anything while there is
/// one.
struct FlightChecks {
  MountingCheck mounting;
  ParallaxCheck parallax = ParallaxCheck();  ///< of the opening's size
  TwistCheck twist = {};
  AttitudeCheck attitude = {};

  /// Wrong if one of them is; good if mounting and velocity are (an IMU is optional).
  FramesVerdict frames() const;

  void clear();
  /// The odometry frame has changed; findings about the frames stay.
  void forgetPlaces();
};

}  // namespace window_ingress::estimation
