#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <string>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/window_observation.hpp"

namespace window_ingress::detection {

/// The reference as it is understood, for people: the inner border in green, corner 1 marked; the two bands
/// whose colours are compared, the frame's tinted orange and the surround's blue, everything else faded;
/// below, a line of text. \return CV_8UC3, higher than the image by that line
cv::Mat drawReference(const ReferenceAppearance& reference);

/// Draws what happened to each candidate of an image (P10): rejected ones thin, in the colour of their gate
/// with a legend, the best of them with gate and margin in words; the target as a green quadrilateral with a
/// yellow centroid, of a partial one the sides that are seen; below, one line with the figures.
/// \param image CV_8UC1 or CV_8UC3, as it went into the detector
/// \param window the target, or null
/// \param canvas CV_8UC3 of the same size, reused where it fits
/// \param milliseconds what the detection took, if that is known
void drawDetection(const cv::Mat& image, const DetectionTrace& trace, const WindowObservation* window,
                   cv::Mat& canvas, std::optional<double> milliseconds = std::nullopt);

/// Writes a text about the target, such as its relative yaw, below it, as far as there is room.
void drawYaw(cv::Mat& canvas, const WindowObservation& window, const std::string& text);

/// Colour of a gate in these images.
cv::Scalar colourOf(RejectReason reason);

}  // namespace window_ingress::detection
