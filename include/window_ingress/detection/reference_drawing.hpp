#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::detection {

/// Shows how the reference is interpreted: the inner border in green with corner 1 marked, the two bands
/// whose colours are compared (frame orange, surround blue), everything else faded, and a line of text below.
/// \return CV_8UC3, higher than the image by that line
cv::Mat drawReference(const ReferenceAppearance& reference);

}  // namespace window_ingress::detection
