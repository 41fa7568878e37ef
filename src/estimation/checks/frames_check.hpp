#pragma once

#include "estimation/checks/attitude_check.hpp"
#include "estimation/checks/mounting_check.hpp"
#include "estimation/checks/twist_check.hpp"

namespace window_ingress::estimation {

/// Verifies camera mounting, attitude and velocity frame in the first metres of motion, by predictions of
/// what is seen and flown. A mismatch is named; do not fly towards anything while there is one.
struct FramesCheck {
  MountingCheck mounting;
  TwistCheck twist = {};
  AttitudeCheck attitude = {};

  /// Wrong if one of them is; good if mounting and velocity are (an IMU is optional).
  FramesVerdict verdict() const;

  void clear();
  /// The odometry frame has changed; findings stay.
  void forgetPlaces();
};

}  // namespace window_ingress::estimation
