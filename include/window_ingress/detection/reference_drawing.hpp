#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::detection {

/// The reference as it is understood, for people: the inner border in green, corner 1 marked; the two bands
/// whose colours are compared, the frame's tinted orange and the surround's blue, everything else faded;
/// below, a line of text. \return CV_8UC3, higher than the picture by that line
cv::Mat drawReference(const ReferenceAppearance& reference, const AppearanceParams& params);

}  // namespace window_ingress::detection
