#pragma once

#include <optional>
#include <vector>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// A window in one image, the target or another one.
struct SeenWindow {
  geometry::Quadrilateral corners;  ///< in canonical order, pixels of the image as it came
  double score = 0.0;               ///< 0 (barely passed the gates) to 1 (certain)
  bool has_appearance = false;      ///< it could be compared with a reference
  double bhattacharyya = 0.0;       ///< 0 identical to 1 disjoint; only if has_appearance
  bool is_target = false;           ///< the one that is observed in this image
  bool may_be_target = false;       ///< nothing but a better one speaks against it
};

/// The windows of a searched image: of candidates that overlap the best one, the target first. What is no
/// window by its geometry is left out, what merely does not look like the reference is not. At most a dozen.
/// \param target as observed in this image, if it was; one that is not whole is left out
/// \param windows filled anew, its memory kept
void windowsSeen(const DetectionTrace& trace, const std::optional<WindowObservation>& target,
                 std::vector<SeenWindow>& windows);

}  // namespace window_ingress::detection
