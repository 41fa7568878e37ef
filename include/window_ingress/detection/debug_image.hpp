#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// Draws what happened to each candidate of an image (P10): rejected ones thin, in the colour of their gate
/// with a legend, and the best of them with gate and margin in words. The target is a green quadrilateral
/// with a yellow centroid; a partial target shows its visible sides. The figures stand in a line below.
/// \param image CV_8UC1 or CV_8UC3, as it went into the detector
/// \param window the target, or null
/// \param canvas CV_8UC3 of the same size, reused if it fits
/// \param milliseconds duration of the detection, if known
void drawDetection(const cv::Mat& image, const DetectionTrace& trace, const WindowObservation* window,
                   cv::Mat& canvas, std::optional<double> milliseconds = std::nullopt);

/// Writes a text, such as the relative yaw, below the target if there is room.
void drawYaw(cv::Mat& canvas, const WindowObservation& window, const std::string& text);

/// Shows how the reference is interpreted: the inner border in green with corner 1 marked, the two bands
/// whose colours are compared (frame orange, surround blue), everything else faded, and a line of text below.
/// \return CV_8UC3, higher than the image by that line
cv::Mat drawReference(const ReferenceAppearance& reference);

/// Colour of a gate in these images.
cv::Scalar colourOf(RejectReason reason);

}  // namespace window_ingress::detection
