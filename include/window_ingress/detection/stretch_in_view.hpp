#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// A straight stretch of the undistorted image.
struct Stretch {
  Eigen::Vector2d from, to;
  double length() const { return (to - from).norm(); }
};

/// The part of a stretch that the picture shows, `margin_px` from its border; the longest part if a lens cuts
/// it into several. Nothing if it shows none.
/// \param lens null where the image is free of distortion
std::optional<Stretch> stretchInView(const Stretch& whole, const cv::Size& image, double margin_px,
                                     const geometry::PinholeCamera* lens);

}  // namespace window_ingress::detection
