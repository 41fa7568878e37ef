#pragma once

#include <Eigen/Core>

#include "detection/borders/lines.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// How far a quadrilateral may move unforeseen between two images, as standard deviations.
struct QuadSpread {
  double place_px = 1.0;    ///< of its two coordinates
  double reshape_px = 1.0;  ///< of size and roll, at its corners
  double warp_px = 0.3;     ///< of aspect, skew and the two keystones, at its corners
};

/// Where the four corners of a window are in the undistorted image, seen or not: a linear estimate of their
/// eight coordinates with a covariance, moved from image to image and corrected by the borders that are
/// seen (each gives an offset and a direction).
///
/// Eight numbers describe the change of a quadrilateral: two of place, size, roll, aspect, skew, two of
/// keystone. What borders tell of them:
/// - four borders: all eight.
/// - three (say top unseen): place across the parallel pair and along it from the third, roll, size by the
///   distance of the pair, keystone of the pair. Aspect, and with it the unseen border, only by assuming that
///   the aspect changed as foreseen (its spread is small: `warp_px`).
/// - two parallel ones: place across them, size by their distance, roll, one keystone. Not the place along
///   them: that rests on attitude and velocity, and its spread grows.
/// - two that meet: place in both coordinates and roll; size only as foreseen by its velocity.
class QuadMotion {
 public:
  using Vector8d = Eigen::Matrix<double, 8, 1>;
  using Matrix8d = Eigen::Matrix<double, 8, 8>;

  /// All corners known; nothing known of their motion.
  void start(const geometry::Quadrilateral& quad, double sigma_px);

  /// To the next image: through the homography of the turn in between, then at constant velocity.
  void predict(const Eigen::Matrix3d& turn, double elapsed_sec, const QuadSpread& spread);

  /// The border of a side as seen.
  void correct(int side, const Line& line);

  /// After the corrections of an image: how fast it moves. \param elapsed_sec as in `predict`
  void settle(double elapsed_sec);

  /// All four seen: they are where their borders meet.
  void place(const geometry::Quadrilateral& quad);

  geometry::Quadrilateral quad() const;
  const geometry::Quadrilateral& predicted() const { return predicted_; }
  /// Standard deviation across a side, of its end that is known worse [px].
  double sigmaAcross(int side) const;

 private:
  struct Row {
    Vector8d weights = Vector8d::Zero();
    double rest = 0.0, variance = 1.0;
  };
  Row offsetRow(int side, const Line& line) const;
  Row slopeRow(int side, const Line& line) const;
  void correct(const Row& row);
  Eigen::Vector2d corner(int i) const { return corners_.segment<2>(2 * (i % 4)); }

  Vector8d corners_ = Vector8d::Zero(), velocity_ = Vector8d::Zero();
  Matrix8d covariance_ = Matrix8d::Identity();
  geometry::Quadrilateral predicted_;
  bool has_velocity_ = false;
};

}  // namespace window_ingress::detection
