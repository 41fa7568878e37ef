#pragma once

#include <Eigen/Core>
#include <array>
#include <opencv2/core.hpp>
#include <optional>

#include "detection/alignment/homography_sums.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Width over height of an opening, as its reference image shows it.
struct OpeningAspect {
  double value = 1.0;
  double log_sigma = 0.0;  ///< of its logarithm; above 0
};

using RowVector8d = Eigen::Matrix<double, 1, 8>;

/// Where a map takes the corners of the opening; false if that is no convex quadrilateral before the camera.
bool cornersOf(const Eigen::Matrix3d& map, geometry::Quadrilateral& quad);

/// How far a change p of a map, to map * (1 + P), moves a corner along a direction of the image.
RowVector8d slopeAcross(const Eigen::Matrix3d& map, int corner, const Eigen::Vector2d& direction);

/// From where one side of a rectangle is seen.
struct SideView {
  double tangent = 0.0;      ///< of the angle, across the side, between the line of sight and the normal
  bool from_beyond = false;  ///< the camera stands before the wall beyond the side
};

/// A view of which three sides are known.
struct CompletedView {
  Eigen::Matrix3d map;  ///< from the opening, its sides of length 1, to ideal pixels
  double sigma_px;      ///< of the ends of the fourth, across it
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

  /// How far a map is from any view of the rectangle: chi with two degrees of freedom.
  double misfit(const Eigen::Matrix3d& map) const;

  /// The map with one side where it must lie by the three others; nothing where they hardly tell.
  std::optional<CompletedView> completed(const Eigen::Matrix3d& map, int side) const;

  /// Top, right, bottom, left of the opening in this view. \param map as above
  std::array<SideView, 4> viewsOfSides(const Eigen::Matrix3d& map) const;

 private:
  /// What would be 0, its slopes by p and variance.
  struct Contradiction {
    double value;
    Eigen::Matrix<double, 1, 8> slope;
    double variance;
  };
  std::optional<std::array<Contradiction, 2>> contradictions(const Eigen::Matrix3d& map) const;

  Eigen::Matrix3d inverse_camera_;
  OpeningAspect aspect_;
  Eigen::Vector3d camera_sigma_ =
      Eigen::Vector3d::Zero();  ///< of the focal length's logarithm, and of the centre [focal lengths]
};

}  // namespace window_ingress::detection
