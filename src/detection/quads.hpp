#pragma once

#include <opencv2/core.hpp>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

inline constexpr double kSkip = 0.06;  ///< left out at both ends of a side: corners are rounded [its lengths]

/// Of vectors of the plane.
inline double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Root of a quadrilateral's area [px].
double sizeOf(const geometry::Quadrilateral& quad);
/// Mean length of its four sides [px].
double meanSide(const geometry::Quadrilateral& quad);
/// How far the corner that differs most lies from its counterpart [px].
double furthestCorner(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b);

/// Of the corner nearest to the image's border, or furthest beyond it: then negative [px].
double distanceToBorder(const geometry::Quadrilateral& quad, const cv::Size& image);

/// The camera if its lens bends the image, else null.
const geometry::PinholeCamera* lensOf(const geometry::PinholeCamera* camera);

/// Corners of the undistorted image and of the image as it came. \param lens null where they are the same
geometry::Quadrilateral undistorted(geometry::Quadrilateral quad, const geometry::PinholeCamera* lens);
geometry::Quadrilateral distorted(geometry::Quadrilateral quad, const geometry::PinholeCamera* lens);

/// Which others are the same as one quadrilateral, in the three senses in which detection asks. Its size sets
/// how far they reach: ask the one that was chosen first about the newcomer, or a large loop takes a small
/// window's place.
class Sameness {
 public:
  explicit Sameness(const geometry::Quadrilateral& quad);

  /// The same four edges: every corner within 1 px and 0.005 of its size.
  bool sameQuad(const geometry::Quadrilateral& other) const { return isWithin(other, same_px_); }
  /// Edges of the same window, such as the two borders of its frame: every corner within 0.2 of its size.
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
