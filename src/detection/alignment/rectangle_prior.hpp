#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>

#include "detection/alignment/homography_sums.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Width over height of an opening, as its reference image shows it.
struct OpeningAspect {
  double value = 1.0;
  double log_sigma = 0.0;  ///< of its logarithm; above 0
};

/// From where one side of a rectangle is seen.
struct SideView {
  double tangent = 0.0;      ///< of the angle, across the side, between the line of sight and the normal
  bool from_beyond = false;  ///< the camera stands before the wall beyond the side
};

/// What is known of a homography before anything is seen: that it is a camera's view of a rectangle. Of its
/// eight numbers six are a pose's; the other two, the aspect and the angle between its sides, are free only
/// as far as they, or the camera, are uncertain. Where a part of the ring is hidden, nothing else keeps the
/// homography from shearing.
class RectanglePrior {
 public:
  RectanglePrior(const geometry::PinholeCamera& camera, const OpeningAspect& aspect);

  /// Of a camera without a calibration: some 41 to 80 degrees across the image, which may have been cut out
  /// of a larger one. The less the rectangle is foreshortened, the more that says.
  RectanglePrior(const cv::Size& image, const OpeningAspect& aspect);

  /// Adds it to the normal equations of a step p, for maps that become map * (1 + P)^-1.
  /// \param map from the opening, its sides of length 1, to ideal pixels \param noise variance of a residual
  void addTo(const Eigen::Matrix3d& map, double noise, Matrix8f& normal, Vector8f& right) const;

  /// Top, right, bottom, left of the opening in this view. \param map as above
  std::array<SideView, 4> viewsOfSides(const Eigen::Matrix3d& map) const;

 private:
  Eigen::Matrix3d inverse_camera_;
  OpeningAspect aspect_;
  Eigen::Vector3d camera_sigma_ =
      Eigen::Vector3d::Zero();  ///< of the focal length's logarithm, and of the centre [focal lengths]
};

}  // namespace window_ingress::detection
