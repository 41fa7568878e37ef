/// Diagnostics of the pose node: results of its checks.
#pragma once

#include <window_ingress/ApparentOpening.h>

#include <optional>
#include <string>

#include "adapters/runtime/diagnostics.hpp"
#include "window_ingress/estimation/clock_check.hpp"
#include "window_ingress/estimation/consistency_monitor.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/estimation/target_estimate.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::adapters {

Health framesHealth(const estimation::FramesVerdict& frames);
/// Warns of a certain offset from 50 ms on. Reports odometry stamped ahead of its arrival (corrected).
Health clocksHealth(const std::optional<estimation::ClockCheck::Offset>& offset,
                    const estimation::SenderClock& odometry);
Health opennessHealth(const openness::OpennessVerdict& verdict);
Health consistencyHealth(const estimation::Consistency& consistency);

/// Images that show a window while no target is known.
struct UnusedImages {
  void add(const std::string& why_not, const window_ingress::ApparentOpening& opening);
  int count = 0;
  std::string why;                          ///< why the last image was not used
  double aspect = 0.0, aspect_sigma = 0.0;  ///< width over height of the last window; 0: none
};
/// An error if many images could not be used; names both aspect ratios if the opening's differs.
Health targetHealth(const UnusedImages& unused, const geometry::OpeningSize& wanted);

}  // namespace window_ingress::adapters
