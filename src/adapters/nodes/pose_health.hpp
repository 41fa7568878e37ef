/// What the pose node's diagnostics say of what was found out on the way.
#pragma once

#include <optional>

#include "adapters/sources/diagnostics.hpp"
#include "window_ingress/estimation/clock_check.hpp"
#include "window_ingress/estimation/consistency_monitor.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/frames_verdict.hpp"
#include "window_ingress/estimation/sender_clock.hpp"
#include "window_ingress/openness/openness_verdict.hpp"

namespace window_ingress::adapters {

Health framesHealth(const estimation::FramesVerdict& frames);
/// A warning from 50 ms on, if that is certain. Odometry stamped ahead of its arrival is said, and corrected.
Health clocksHealth(const std::optional<estimation::ClockCheck::Offset>& offset,
                    const estimation::SenderClock& odometry);
Health opennessHealth(const openness::OpennessVerdict& verdict);
Health consistencyHealth(const estimation::Consistency& consistency);

}  // namespace window_ingress::adapters
