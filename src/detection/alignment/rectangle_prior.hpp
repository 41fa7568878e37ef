#pragma once

#include <opencv2/core.hpp>

#include "detection/alignment/homography_sums.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// Width over height of an opening, as seen in its reference image.
struct OpeningAspect {
  double value = 1.0;
  double log_sigma = 0.0;  ///< standard deviation of the logarithm of `value`; above 0
};

/// Width and height of an opening of this aspect [its mean sides].
inline Eigen::Vector2d shapeOf(double aspect) {
  return {2.0 * aspect / (1.0 + aspect), 2.0 / (1.0 + aspect)};
}

using RowVector8d = Eigen::Matrix<double, 1, 8>;

/// Corners of the opening in the image; nothing if they form no convex quadrilateral in front of the camera.
std::optional<geometry::Quadrilateral> cornersOf(const Eigen::Matrix3d& map);

/// How far a corner moves along a direction of the image when its map changes by p to map * (1 + P).
RowVector8d slopeAcross(const Eigen::Matrix3d& map, int corner, const Eigen::Vector2d& direction);

/// Direction from which one side of a rectangle is seen.
struct SideView {
  double tangent = 0.0;      ///< of the angle between line of sight and normal, measured across the side
  bool from_beyond = false;  ///< the camera stands in front of the wall beyond this side
};

/// A view completed from three known sides.
struct CompletedView {
  Eigen::Matrix3d map;  ///< from the opening, scaled to unit sides, to undistorted pixels
  double sigma_px;      ///< standard deviation of the ends of the fourth side, across it
};

/// Prior on a homography: it is a camera's view of a rectangle. Six of its eight numbers belong to the pose.
/// The other two, the aspect and the angle between the sides, may vary only as far as they or the camera are
/// uncertain. Where a part of the ring is hidden, only this prior keeps the homography from shearing.
class RectanglePrior {
 public:
  RectanglePrior(const geometry::PinholeCamera& camera, const OpeningAspect& aspect);

  /// For a camera without calibration: a horizontal field of view of some 41 to 80 degrees, and an image that
  /// may be cropped. The less the rectangle is foreshortened, the tighter the prior.
  RectanglePrior(const cv::Size& image, const OpeningAspect& aspect);

  /// Adds the prior to the normal equations of a step p, for maps that become map * (1 + P)^-1.
  /// \param map from the opening, scaled to unit sides, to undistorted pixels \param noise variance of a
  /// residual
  void addTo(const Eigen::Matrix3d& map, double noise, Matrix8f& normal, Vector8f& right) const;

  /// Distance of a map from any view of the rectangle: chi with two degrees of freedom.
  double misfit(const Eigen::Matrix3d& map) const;

  /// The map with one side placed from the three others; nothing where they hardly determine it.
  std::optional<CompletedView> completed(const Eigen::Matrix3d& map, int side) const;

  /// Views of the top, right, bottom and left side. \param map as above
  std::array<SideView, 4> viewsOfSides(const Eigen::Matrix3d& map) const;

 private:
  /// A quantity that is 0 for a true view, its derivatives by p, and its variance.
  struct Contradiction {
    double value;
    RowVector8d slope;
    double variance;
  };
  std::optional<std::array<Contradiction, 2>> contradictions(const Eigen::Matrix3d& map) const;

  Eigen::Matrix3d inverse_camera_;
  OpeningAspect aspect_;
  /// Of the focal length's logarithm, of the centre [focal lengths].
  Eigen::Vector3d camera_sigma_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::detection
