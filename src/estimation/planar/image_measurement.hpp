#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// The four corners in canonical order: x0, y0, x1, ... [px of the undistorted image of the same K].
using CornerVector = Eigen::Matrix<double, 8, 1>;

/// Predicted corners of the opening, with derivatives by the pose and by the opening's size.
struct PredictedOpening {
  CornerVector corners_px = CornerVector::Zero();
  /// By translation [px/m] and rotation about the camera's fixed axes, at the window's origin [px/rad].
  Eigen::Matrix<double, 8, 6> by_pose = Eigen::Matrix<double, 8, 6>::Zero();
  /// By log width and log height [px].
  Eigen::Matrix<double, 8, 2> by_log_size = Eigen::Matrix<double, 8, 2>::Zero();
};

/// Nothing unless all corners lie in front of the camera.
std::optional<PredictedOpening> predictOpening(const geometry::PinholeCamera& camera,
                                               const Eigen::Isometry3d& T_camera_window,
                                               const geometry::OpeningSize& size);

/// `T` moved by (dx, dy, dz, rotation vector): translation added, rotation about fixed axes.
Eigen::Isometry3d moved(const Eigen::Isometry3d& T, const Eigen::Matrix<double, 6, 1>& step);

/// Matrix of the cross product: skew(a) * b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Assumed errors of an observation beyond its own covariances.
struct ImageNoise {
  double systematic_sigma_px = 0.15;  ///< of each corner coordinate; the same in every image from one place
  /// Number of images that share their systematic error, including this one. The k-th image counts only by
  /// what it adds to the k - 1 before. The systematic error thus limits the information from one place.
  double looks = 1.0;
  /// The systematic error is renewed with time, too: no measurement gets more than this times the systematic
  /// variance.
  double max_looks_variance = 1e12;
  /// Turn of a border by the systematic error, at its ends, as a part of its shift: 1 where corners err
  /// independently, less where whole borders are displaced.
  double systematic_turn = 1.0;
};

/// Residuals of predicted against measured borders, weighted to unit variance. At most eight.
using Residual = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 8, 1>;
template <int Columns>
using ResidualJacobian = Eigen::Matrix<double, Eigen::Dynamic, Columns, 0, 8, Columns>;

struct LinearisedResidual {
  Residual residual;
  ResidualJacobian<8> by_corners;
};

/// The likelihood of one observation. Borders are fitted independently, so they are uncorrelated, unlike
/// corners that share a border. If the observation has the borders' spreads, the residuals are offset and
/// direction of each *visible border*. Otherwise they are the corners, weighted by their covariances. A
/// partial observation has the visible stretches of its borders, and no corner.
class ImageMeasurement {
 public:
  /// Corners must be in canonical order. Nothing if numbers are not finite or a visible border has no length.
  static std::optional<ImageMeasurement> make(const detection::WindowObservation& window,
                                              const geometry::PinholeCamera& camera, const ImageNoise& noise);

  LinearisedResidual evaluate(const CornerVector& predicted_px) const;

  /// Measured corners, undistorted; the intersections of the four borders in a partial observation.
  const CornerVector& cornersPx() const { return corners_px_; }
  bool hasCorners() const { return has_corners_; }  ///< false: a border is missing, the corners are zero
  int size() const { return 2 * (border_count_ > 0 ? border_count_ : 4); }

 private:
  struct Border {
    int side;
    Eigen::Vector2d middle, along, across;
    double offset_sigma_px, slope_sigma;
  };
  static std::optional<ImageMeasurement> ofPartial(const detection::WindowObservation& window,
                                                   const geometry::PinholeCamera& camera,
                                                   const ImageNoise& noise);
  /// \param from,to points of the border, undistorted
  bool addBorder(const detection::Edge& edge, int side, const Eigen::Vector2d& from,
                 const Eigen::Vector2d& to, const geometry::PinholeCamera& camera, const ImageNoise& noise);
  bool cross();
  void addCorner(const Eigen::Matrix2d& covariance, int corner, const ImageNoise& noise);
  void evaluateBorder(const Border& border, const CornerVector& predicted_px, int row,
                      LinearisedResidual& out) const;

  CornerVector corners_px_ = CornerVector::Zero();
  bool has_corners_ = true;
  int border_count_ = 0;  ///< 0: corners are used instead
  std::array<Border, 4> borders_;
  std::array<Eigen::Matrix2d, 4> corner_weights_;
};

/// Variance of the `looks`-th measurement from one place, such that all of them together weigh 1 / (white /
/// looks + systematic); at most `max_looks_variance * systematic`, at least `white + systematic`.
double marginalVariance(double white, double systematic, const ImageNoise& noise);

}  // namespace window_ingress::estimation
