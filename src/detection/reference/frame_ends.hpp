#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "detection/reference/side_profile.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// For each side of a window: whether its frame is also visible before its beginning and beyond its end.
using FrameEnds = std::array<std::array<bool, 2>, 4>;

/// Finds where frames continue, by their contrast with the wall, in any haze. Only sides count whose frame
/// looks like those of two others. \param image CV_8UC3 \param ideal corners, canonical order, undistorted
/// pixels \param lens null: no distortion \param sides buffers, reused
FrameEnds framesBeyond(const cv::Mat& image, const geometry::Quadrilateral& ideal,
                       const geometry::PinholeCamera* lens, std::array<SideProfile, 4>& sides);

}  // namespace window_ingress::detection
