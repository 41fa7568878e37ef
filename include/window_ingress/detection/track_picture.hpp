#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

struct CandidateTrace;
struct RefinedBorders;

/// A picture that can be looked at: CV_8UC1 or CV_8UC3, not empty.
bool isPicture(const cv::Mat& image);

/// The same size, focal lengths, principal point and distortion.
bool isSameCalibration(const geometry::PinholeCamera& a, const geometry::PinholeCamera& b);

/// Root of a quadrilateral's area [px].
double sizeOf(const geometry::Quadrilateral& quad);

/// Corners of the image as it came and of the undistorted one. \param lens null where they are the same
geometry::Quadrilateral undistorted(geometry::Quadrilateral quad, const geometry::PinholeCamera* lens);
geometry::Quadrilateral distorted(geometry::Quadrilateral quad, const geometry::PinholeCamera* lens);

double furthestCorner(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b);  ///< [px]

}  // namespace window_ingress::detection
