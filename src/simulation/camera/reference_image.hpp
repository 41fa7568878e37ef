#pragma once

#include <opencv2/core.hpp>

#include "simulation/scenario/scenario.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::simulation {

/// The target as an operator would have photographed it on the same day: square, sharp, open, with frame and
/// surround, in the camera's exposure. It shows the target even where the wall or the window is closed by
/// now. \param corners receives those of its opening in that image; may be null \throws std::runtime_error
/// if there is no software renderer
cv::Mat referenceImage(const Scenario& scenario, geometry::Quadrilateral* corners);

}  // namespace window_ingress::simulation
