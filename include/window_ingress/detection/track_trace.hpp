#pragma once

#include <string>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// The trace of a frame in which a window was followed: it is the only candidate, if it is whole.
void traceFollowed(const WindowObservation& window, DetectionTrace& trace);

/// The trace of a search whose window is not taken.
void traceRefused(const DetectionTrace& search, RejectReason reason, const std::string& detail,
                  DetectionTrace& trace);

}  // namespace window_ingress::detection
