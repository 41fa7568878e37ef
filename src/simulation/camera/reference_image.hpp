#pragma once

#include <opencv2/core.hpp>

#include "simulation/scenario/scenario.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::simulation {

/// A photograph of the target as an operator would have taken it on the same day: frontal, sharp, open, with
/// frame and surround, in the camera's exposure. It shows the target even if the wall or the window is closed
/// now. \param corners receives the opening's corners in that image; may be null \throws std::runtime_error
/// if there is no software renderer
cv::Mat referenceImage(const Scenario& scenario, geometry::Quadrilateral* corners);

}  // namespace window_ingress::simulation
