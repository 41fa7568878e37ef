#pragma once

#include <Eigen/Core>
#include <optional>

#include "estimation/planar/predicted_opening.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

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
