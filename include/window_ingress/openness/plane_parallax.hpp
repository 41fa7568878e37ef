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

/// Depth of a point behind the plane, from two images.
struct PointParallax {
  /// Depth D behind the plane over the point's distance from the key camera: D / (d + D), 0 in the plane, 1
  /// at infinity.
  double part = 0.0;
  double part_sigma = 0.0;  ///< border errors included, which all points of the pair share
  double gain_px = 0.0;     ///< shift of the point for a part of 1 [px]
  double across_px = 0.0;   ///< deviation across the direction of parallax, which no depth explains [px]
  double across_sigma_px = 0.0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< where the sight meets the plane now: 0 to 1, right,
                                                    ///< down
};

/// Plane and parallax between a keyframe and a later image (Irani and Anandan 1996): a point at depth D
/// behind the plane moves to H p - part * K t (n . x) / d, where the plane moves by H. H comes from the
/// borders alone and so has no attitude error; odometry gives the baseline t, which only scales the depth.
class PlaneParallax {
 public:
  struct Errors {
    double border_sigma_px = 0.4, position_sigma_m = 0.02, flow_sigma_px = 0.35;
  };
  /// \param camera distortion is not used: all pixels here are undistorted
  /// \param T_camera_window_key,T_camera_window_now only the baseline and the plane are used
  /// \return nothing if the plane is not in front of both cameras or the borders give no homography
  static std::optional<PlaneParallax> between(const geometry::PinholeCamera& camera, const SeenBorder& key,
                                              const SeenBorder& now,
                                              const Eigen::Isometry3d& T_camera_window_key,
                                              const Eigen::Isometry3d& T_camera_window_now,
                                              const Errors& errors);

  /// Nothing if the point is not finite, or the baseline is too short or too close to the line of sight.
  /// \param normal for a point on an edge: the only direction in which its place is known; else zero
  std::optional<PointParallax> of(const Eigen::Vector2d& key_px, const Eigen::Vector2d& now_px,
                                  const Eigen::Vector2d& normal = Eigen::Vector2d::Zero()) const;

  double distanceM() const { return distance_m_; }  ///< of the key camera from the plane
  double baselineM() const { return baseline_m_; }  ///< distance between the two camera positions

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
