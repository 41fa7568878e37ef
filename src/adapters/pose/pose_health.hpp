/// What the pose node's diagnostics say of what was found out on the way.
#pragma once

#include <window_ingress/ApparentOpening.h>

#include <optional>
#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/clock_check.hpp"
#include "window_ingress/estimation/consistency_monitor.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/frames_verdict.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::adapters {

Health framesHealth(const estimation::FramesVerdict& frames);
/// A warning from 50 ms on, if that is certain. Odometry stamped ahead of its arrival is said, and corrected.
Health clocksHealth(const std::optional<estimation::ClockCheck::Offset>& offset,
                    const estimation::SenderClock& odometry);
Health opennessHealth(const openness::OpennessVerdict& verdict);
Health consistencyHealth(const estimation::Consistency& consistency);

/// Images with a window in them while no target is known.
struct UnusedImages {
  void add(const std::string& why_not, const window_ingress::ApparentOpening& opening);
  int count = 0;
  std::string why;                          ///< the last one was not used
  double aspect = 0.0, aspect_sigma = 0.0;  ///< of the last that showed it: width over height; 0: none did
};
/// An error where many could not be used; one that names both shapes where that of the opening is another.
Health targetHealth(const UnusedImages& unused, const geometry::OpeningSize& wanted);

}  // namespace window_ingress::adapters
