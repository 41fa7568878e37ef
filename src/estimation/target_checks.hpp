#pragma once

#include "estimation/checks/frames_check.hpp"
#include "estimation/checks/parallax_check.hpp"
#include "window_ingress/estimation/target_estimator.hpp"

namespace window_ingress::estimation {

/// What the target estimator verifies of what it was told.
struct TargetEstimator::Checks {
  FramesCheck frames;      ///< mounting, attitude, frame of the velocity
  ParallaxCheck parallax;  ///< the opening's size
  bool mounting_is_sure;   ///< it was said to be; nothing has to be verified
};

}  // namespace window_ingress::estimation
