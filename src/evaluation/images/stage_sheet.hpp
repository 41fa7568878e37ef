#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"

namespace window_ingress::evaluation {

/// The stages of the detector on one image, as the paper's figures 1 and 2 show them, with captions: edges
/// with and without preprocessing, straight segments in the colour of their direction, closed edges, contours
/// with their polygons, quadrilaterals of segments, candidates that passed the gates, and the result.
/// \param image CV_8UC1 or CV_8UC3, at least 64 pixels each way. \throws std::invalid_argument
/// \param reference appearance of the target, or null
/// \param cell_width_px width of each of the images, three in a row
/// \return CV_8UC3
cv::Mat stageSheet(const cv::Mat& image, const detection::DetectorParams& params,
                   const detection::ReferenceAppearance* reference, int cell_width_px);

}  // namespace window_ingress::evaluation
