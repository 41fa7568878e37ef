#pragma once

#include <Eigen/Core>

#include "detection/borders/lines.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Unpredicted motion of a quadrilateral between two images, as standard deviations.
struct QuadSpread {
  double place_px = 1.0;    ///< of its two coordinates
  double reshape_px = 1.0;  ///< of size and roll, at its corners
  double warp_px = 0.3;     ///< of aspect, skew and the two keystones, at its corners
};

/// Estimates the four corners of a window in the undistorted image, visible or not: a linear estimate of
/// their eight coordinates with covariance, predicted from image to image and corrected by the visible
/// borders (each gives an offset and a direction).
///
/// Eight numbers describe the change of a quadrilateral: two of place, size, roll, aspect, skew, two of
/// keystone. They follow from the visible borders:
/// - four borders: all eight.
/// - three (for example, top not visible): place across the parallel pair and along it from the third, roll,
///   size from the distance of the pair, keystone of the pair. The aspect, and with it the missing border,
///   follows only from the assumption that the aspect changed as predicted (its spread is small: `warp_px`).
/// - two parallel ones: place across them, size from their distance, roll, one keystone. The place along them
///   follows only from attitude and velocity, and its spread grows.
/// - two that meet: place in both coordinates and roll; size only as predicted from its velocity.
class QuadMotion {
 public:
  using Vector8d = Eigen::Matrix<double, 8, 1>;
  using Matrix8d = Eigen::Matrix<double, 8, 8>;

  /// Starts with known corners and unknown motion.
  void start(const geometry::Quadrilateral& quad, double sigma_px);

  /// Predicts to the next image: by the homography of the rotation in between, then at constant velocity.
  void predict(const Eigen::Matrix3d& turn, double elapsed_sec, const QuadSpread& spread);

  /// Corrects by the visible border of a side.
  void correct(int side, const Line& line);

  /// Updates the velocity, after the corrections of an image. \param elapsed_sec as in `predict`
  void settle(double elapsed_sec);

  /// Sets the corners to the intersections of four visible borders.
  void place(const geometry::Quadrilateral& quad);

  geometry::Quadrilateral quad() const;
  const geometry::Quadrilateral& predicted() const { return predicted_; }
  /// Standard deviation across a side, at its less certain end [px].
  double sigmaAcross(int side) const;

 private:
  /// By a measurement that weighs the two corners of a side. \param rest it less its prediction
  void correct(int side, const Eigen::Vector2d& from, const Eigen::Vector2d& to, double rest, double sigma);
  Eigen::Vector2d corner(int i) const { return corners_.segment<2>(2 * (i % 4)); }

  Vector8d corners_ = Vector8d::Zero(), velocity_ = Vector8d::Zero();
  Matrix8d covariance_ = Matrix8d::Identity();
  geometry::Quadrilateral predicted_;
  bool has_velocity_ = false;
};

}  // namespace window_ingress::detection
