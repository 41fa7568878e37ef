#pragma once

#include <optional>
#include <vector>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// A window in one image, the target or another one.
struct SeenWindow {
  geometry::Quadrilateral corners;  ///< in canonical order, distorted pixels
  double score = 0.0;               ///< 0 (barely passed the gates) to 1 (certain)
  bool has_appearance = false;      ///< the window was compared with a reference
  double bhattacharyya = 0.0;       ///< 0 identical to 1 disjoint; only if has_appearance
  bool is_target = false;           ///< the window observed as the target in this image
  bool may_be_target = false;       ///< only a better candidate excludes it
};

/// The windows of a searched image, the target first. Of overlapping candidates only the best is kept.
/// Candidates rejected by their geometry are left out; those that only look unlike the reference are kept. At
/// most a dozen.
/// \param target as observed in this image, if it was; a partial target is left out
/// \param windows replaced; its memory is reused
void windowsSeen(const DetectionTrace& trace, const std::optional<WindowObservation>& target,
                 std::vector<SeenWindow>& windows);

}  // namespace window_ingress::detection
