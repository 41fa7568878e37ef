#pragma once

#include "estimation/checks/frames_check.hpp"
#include "estimation/checks/parallax_check.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::estimation {

/// Checks by the target estimator of what it was configured with.
struct TargetEstimator::Checks {
  FramesCheck frames;      ///< mounting, attitude, frame of the velocity
  ParallaxCheck parallax;  ///< the opening's size
  bool mounting_is_sure;   ///< stated as sure, so it is not verified
};

}  // namespace window_ingress::estimation
