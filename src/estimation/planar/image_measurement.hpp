#pragma once

#include <Eigen/Core>
#include <optional>

#include "estimation/planar/predicted_opening.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// What is assumed of the errors of an observation beyond its own covariances.
struct ImageNoise {
  double systematic_sigma_px = 0.15;  ///< of each corner coordinate; the same in every image from one place
  /// How many images, this one included, share their systematic error. The k-th of them brings only what it
  /// adds to the k - 1 before: any number of images from one place tells no more than the systematic error
  /// lets through.
  double looks = 1.0;
  /// The systematic error is renewed in time as well: no measurement gets more than this times its variance.
  double max_looks_variance = 1e12;
  /// By how much of what it shifts a border the systematic error turns it, at its ends: 1 where corners err
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

/// The likelihood of one observation. Borders are lines fitted independently of each other, so where the
/// observation brings their spreads, the residuals are offset and direction of each *visible border* (corners
/// that share a border are correlated; borders are not). Else they are the corners, weighted by their
/// covariances. A partial observation has the stretches of its visible borders that were seen, and no corner.
class ImageMeasurement {
 public:
  /// Corners must be in canonical order. Nothing if numbers are not finite or a visible border has no length.
  static std::optional<ImageMeasurement> make(const detection::WindowObservation& window,
                                              const geometry::PinholeCamera& camera, const ImageNoise& noise);

  LinearisedResidual evaluate(const CornerVector& predicted_px) const;

  /// Measured, undistorted; of a partial observation where its four borders cross.
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

/// Variance that the `looks`-th measurement from one place must be given, so that all of them together weigh
/// 1 / (white / looks + systematic); at most `max_looks_variance * systematic`, at least `white +
/// systematic`.
double marginalVariance(double white, double systematic, const ImageNoise& noise);

}  // namespace window_ingress::estimation
