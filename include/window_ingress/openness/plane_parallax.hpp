#pragma once

#include <Eigen/Geometry>
#include <array>
#include <optional>

#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"
#include "window_ingress/geometry/unit_square.hpp"

namespace window_ingress::openness {

/// The opening's four corners in one image, undistorted [px], and their covariances [px^2].
struct SeenBorder {
  geometry::Quadrilateral corners;
  std::array<Eigen::Matrix2d, 4> covariance;
};

/// The homography by which a plane's image becomes another, from four corners of it in both. Nothing if
/// they determine none.
std::optional<Eigen::Matrix3d> homographyBetween(const geometry::Quadrilateral& from,
                                                 const geometry::Quadrilateral& to);

/// How far behind the plane a point lies, by two images of it.
struct PointParallax {
  /// Depth D behind the plane over its distance from the key camera: D / (d + D), 0 in the plane, 1 at
  /// infinity.
  double part = 0.0;
  double part_sigma = 0.0;  ///< with all errors; those of the borders are common to all points of the pair
  double gain_px = 0.0;     ///< what a part of 1 moves the point [px]
  double across_px = 0.0;   ///< what no depth explains: deviation across the direction of parallax [px]
  double across_sigma_px = 0.0;
  Eigen::Vector2d place =
      Eigen::Vector2d::Zero();  ///< where the sight crosses the plane now: 0 to 1, right, down
};

/// Plane and parallax between a key image and a later one: a point at depth D behind the plane moves to
/// H p - part * K t (n . x) / d (Irani and Anandan 1996), where the plane moves by H. H comes from the
/// borders alone and so bears no error of attitude; the odometry gives the way t, which only scales the
/// depth.
class PlaneParallax {
 public:
  struct Errors {
    double border_sigma_px = 0.4, position_sigma_m = 0.02, flow_sigma_px = 0.35;
  };
  /// \param camera its distortion is not used: all pixels here are undistorted
  /// \param T_camera_window_key,T_camera_window_now of which only the way between and the plane are used
  /// \return nothing if the plane is not in front of both cameras or the borders give no homography
  static std::optional<PlaneParallax> between(const geometry::PinholeCamera& camera, const SeenBorder& key,
                                              const SeenBorder& now,
                                              const Eigen::Isometry3d& T_camera_window_key,
                                              const Eigen::Isometry3d& T_camera_window_now,
                                              const Errors& errors);

  /// Nothing if the point is not finite, or the way so short or along its sight that no depth would move it.
  /// \param normal of a point on an edge: the direction in which alone its place is known; zero: in both
  std::optional<PointParallax> of(const Eigen::Vector2d& key_px, const Eigen::Vector2d& now_px,
                                  const Eigen::Vector2d& normal = Eigen::Vector2d::Zero()) const;

  double distanceM() const { return distance_m_; }  ///< of the key camera from the plane
  double baselineM() const { return baseline_m_; }  ///< length of the way between the two images

 private:
  explicit PlaneParallax(const geometry::Quadrilateral& now) : opening_(now) {}
  double borderVariance(const Eigen::Vector2d& place, const Eigen::Vector2d& along) const;

  Eigen::Matrix3d H_, K_inverse_;
  geometry::UnitSquare opening_;  ///< in the later image
  Eigen::Vector3d epipole_, normal_;
  SeenBorder key_, now_;
  Errors errors_;
  double growth_ = 1.0, distance_m_ = 0.0, baseline_m_ = 0.0, px_per_m_ = 0.0;
};

}  // namespace window_ingress::openness
