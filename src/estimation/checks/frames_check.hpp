#pragma once

#include "estimation/checks/attitude_check.hpp"
#include "estimation/checks/mounting_check.hpp"
#include "estimation/checks/twist_check.hpp"

namespace window_ingress::estimation {

/// Camera mounting, attitude and velocity frame, verified in the first metres of motion: what is predicted
/// against what is seen and flown. A mismatch is named; with it nobody should fly towards anything.
struct FramesCheck {
  MountingCheck mounting;
  TwistCheck twist = {};
  AttitudeCheck attitude = {};

  /// Wrong if one of them is; good if mounting and velocity are (an imu need not be there).
  FramesVerdict verdict() const;

  void clear();
  /// The odometry frame is another one; what was found out stays.
  void forgetPlaces();
};

}  // namespace window_ingress::estimation
