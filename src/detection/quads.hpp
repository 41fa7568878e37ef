#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

inline constexpr double kSkip =
    0.06;  ///< skipped at both ends of a side, because corners are rounded [its lengths]

/// Cross product of two vectors in the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Root of a quadrilateral's area [px].
double sizeOf(const geometry::Quadrilateral& quad);
/// Mean length of its four sides [px].
double meanSide(const geometry::Quadrilateral& quad);
/// How far the corner that differs most lies from its counterpart [px].
double furthestCorner(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b);

/// Distance of the outermost corner from the image's border, negative outside the image [px].
double distanceToBorder(const geometry::Quadrilateral& quad, const cv::Size& image);

/// The camera if its lens distorts the image, else null.
const geometry::PinholeCamera* lensOf(const geometry::PinholeCamera* camera);

/// Convert corners between raw and undistorted image. \param lens null: no distortion
geometry::Quadrilateral undistorted(geometry::Quadrilateral quad, const geometry::PinholeCamera* lens);
geometry::Quadrilateral distorted(geometry::Quadrilateral quad, const geometry::PinholeCamera* lens);

/// Compares other quadrilaterals with one, in the three senses of sameness that detection uses. Tolerances
/// follow from its size. Construct it from the quadrilateral chosen first, or a large loop takes a small
/// window's place.
class Sameness {
 public:
  explicit Sameness(const geometry::Quadrilateral& quad);

  /// The same four edges: every corner within 1 px and 0.005 of its size.
  bool sameQuad(const geometry::Quadrilateral& other) const { return isWithin(other, same_px_); }
  /// Edges of the same window, for example both borders of its frame: every corner within 0.2 of its size.
  bool samePlace(const geometry::Quadrilateral& other) const { return isWithin(other, place_px_); }
  /// The same window: the intersection is more than 0.6 of the union.
  bool sameWindow(const geometry::Quadrilateral& other) const;

 private:
  bool isWithin(const geometry::Quadrilateral& other, double limit_px) const {
    for (int i = 0; i < 4; ++i)
      if ((other[i] - quad_[i]).squaredNorm() > limit_px * limit_px) return false;
    return true;
  }

  geometry::Quadrilateral quad_;
  double same_px_, place_px_;
};

}  // namespace window_ingress::detection
