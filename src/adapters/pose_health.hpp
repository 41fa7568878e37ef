/// What the pose node's diagnostics say of what was found out on the way.
#pragma once

#include <optional>

#include "adapters/diagnostics.hpp"
#include "window_ingress/openness/openness_verdict.hpp"
#include "window_ingress/pose/clock_check.hpp"
#include "window_ingress/pose/consistency_monitor.hpp"
#include "window_ingress/pose/filter_params.hpp"
#include "window_ingress/pose/frames_params.hpp"
#include "window_ingress/pose/sender_clock.hpp"

namespace window_ingress::adapters {

Health framesHealth(const pose::FramesVerdict& frames);
/// A warning from 50 ms on, if that is certain. Odometry stamped ahead of its arrival is said, and corrected.
Health clocksHealth(const std::optional<pose::ClockCheck::Offset>& offset, const pose::SenderClock& odometry);
Health opennessHealth(const openness::OpennessVerdict& verdict);
Health consistencyHealth(const pose::Consistency& consistency, const pose::FilterParams& params);

}  // namespace window_ingress::adapters
