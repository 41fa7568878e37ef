#pragma once

#include <Eigen/Core>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One picture and what else is known about its moment.
struct TrackInput {
  cv::Mat image;                                    ///< CV_8UC1 or CV_8UC3 (BGR); not kept
  double stamp_sec = 0.0;                           ///< exposure
  const geometry::PinholeCamera* camera = nullptr;  ///< calibration of the image if there is one
  std::optional<Eigen::Matrix3d> R_world_camera;    ///< attitude at the exposure, if known
  /// Where the memory of all windows says the target is, in pixels of the image as it came, if it knows:
  /// nothing else is the target.
  std::optional<geometry::Quadrilateral> expected;
};

}  // namespace window_ingress::detection
