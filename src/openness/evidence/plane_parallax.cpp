#include "window_ingress/openness/plane_parallax.hpp"

#include <Eigen/LU>
#include <cmath>

namespace window_ingress::openness {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kMinDistance_m = 0.2;
constexpr double kMinGain_px = 0.5;

bool isUsable(const geometry::Quadrilateral& corners) {
  return geometry::isFinite(corners) && geometry::isConvex(corners);
}

}  // namespace

std::optional<PlaneParallax> PlaneParallax::between(const geometry::PinholeCamera& camera,
                                                    const SeenBorder& key, const SeenBorder& now,
                                                    const Eigen::Isometry3d& T_camera_window_key,
                                                    const Eigen::Isometry3d& T_camera_window_now,
                                                    const Errors& errors) {
  if (!isUsable(key.corners) || !isUsable(now.corners) || !T_camera_window_key.matrix().allFinite() ||
      !T_camera_window_now.matrix().allFinite())
    return std::nullopt;
  PlaneParallax pair(now.corners);
  Matrix3d H = pair.opening_.matrix() * geometry::UnitSquare(key.corners).matrix().inverse();
  H /= H(2, 2);
  pair.normal_ = T_camera_window_key.linear().col(0);
  pair.distance_m_ = pair.normal_.dot(T_camera_window_key.translation());
  const double now_m = T_camera_window_now.linear().col(0).dot(T_camera_window_now.translation());
  const double determinant = H.determinant();
  if (!(pair.distance_m_ > kMinDistance_m && now_m > kMinDistance_m && determinant > 0.0) || !H.allFinite())
    return std::nullopt;
  // The homography of calibrated rays, R + t n^T / d, has the determinant d_now / d.
  pair.H_ = std::cbrt(now_m / pair.distance_m_ / determinant) * H;
  const Vector3d way = (T_camera_window_now * T_camera_window_key.inverse()).translation();
  pair.epipole_ = camera.K() * way / pair.distance_m_;
  pair.K_inverse_ = camera.K().inverse();
  pair.key_ = key, pair.now_ = now, pair.errors_ = errors;
  pair.growth_ = std::sqrt(geometry::signedArea(now.corners) / geometry::signedArea(key.corners));
  pair.baseline_m_ = way.norm();
  pair.px_per_m_ = camera.fx / now_m;
  return pair;
}

// Variance of this point along a direction, due to the borders of both images.
double PlaneParallax::borderVariance(const Vector2d& place, const Vector2d& along) const {
  const double u = place.x(), v = place.y();
  const Eigen::Vector4d weights((1 - u) * (1 - v), u * (1 - v), u * v, (1 - u) * v);  // of each corner
  const double common = std::pow(errors_.border_sigma_px, 2);
  double variance = 0.5 * common * (1.0 + growth_ * growth_);
  for (int i = 0; i < 4; ++i) {
    const Eigen::Matrix2d both = now_.covariance[i] + growth_ * growth_ * key_.covariance[i];
    variance += weights(i) * weights(i) * along.dot(both * along);
  }
  return variance;
}

std::optional<PointParallax> PlaneParallax::of(const Vector2d& key_px, const Vector2d& now_px,
                                               const Vector2d& normal) const {
  const Vector3d plane = H_ * key_px.homogeneous();
  const Vector3d shift = epipole_ * normal_.dot(K_inverse_ * key_px.homogeneous());
  // now x (plane - part * shift) = 0, divided by the point's own depth: two equations in pixels.
  Vector2d by_part = shift.head<2>() - now_px * shift.z();
  Vector2d off = plane.head<2>() - now_px * plane.z();
  if (!normal.isZero(0.0)) {
    by_part = normal.dot(by_part) * normal;
    off = normal.dot(off) * normal;
  }
  const double squares = by_part.squaredNorm();
  PointParallax point;
  point.part = by_part.dot(off) / squares;
  const double depth = plane.z() - point.part * shift.z();
  if (!std::isfinite(point.part) || !(depth > 0.05 * plane.z())) return std::nullopt;
  point.gain_px = std::sqrt(squares) / depth;
  if (!(point.gain_px > kMinGain_px)) return std::nullopt;
  const Vector2d along = by_part.normalized(), across(-along.y(), along.x());
  point.across_px = across.dot(off) / depth;
  point.place = opening_.fromImage(now_px);
  const double flow = std::pow(errors_.flow_sigma_px, 2);
  // The baseline follows from two positions.
  const double way = 2.0 * std::pow(point.part * errors_.position_sigma_m, 2);
  point.part_sigma = std::sqrt((flow + borderVariance(point.place, along)) / std::pow(point.gain_px, 2) +
                               way / std::pow(baseline_m_, 2));
  point.across_sigma_px = std::sqrt(flow + borderVariance(point.place, across) + way * px_per_m_ * px_per_m_);
  return point;
}

}  // namespace window_ingress::openness
