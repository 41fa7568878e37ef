#include "window_ingress/facade/window_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::facade {
namespace {

constexpr double kMaxOblique = 0.2;  // cosine between line of sight and window's axis
constexpr double kFurthestM = 40.0;
constexpr double kCornerSigmaPx = 3.0;     // of a corner found by a search
constexpr double kRangeSigma = 0.3;        // relative, of a distance that follows from the expected size
constexpr double kBearingSigmaRad = 0.01;  // of the camera in odom

Eigen::Vector3d wayThrough(double heading_rad) { return {std::cos(heading_rad), std::sin(heading_rad), 0.0}; }

Eigen::Matrix3d spread(const Eigen::Vector3d& along, double sigma_along, double sigma_across) {
  const Eigen::Matrix3d outer = along * along.transpose();
  return sigma_along * sigma_along * outer +
         sigma_across * sigma_across * (Eigen::Matrix3d::Identity() - outer);
}

double acrossSigma(const Viewpoint& view, double range_m) {
  return range_m * std::hypot(kCornerSigmaPx / view.camera.fx, kBearingSigmaRad);
}

std::optional<WindowPlace> onWall(const geometry::Quadrilateral& corners, const Viewpoint& view,
                                  const Wall& wall) {
  const Eigen::Vector3d through = wayThrough(wall.heading_rad), eye = view.T_odom_camera.translation();
  const double ahead_m = through.dot(wall.position_m - eye);
  std::array<Eigen::Vector3d, 4> points;
  double least_cosine = 1.0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector3d ray = view.T_odom_camera.linear() * view.camera.ray(corners[i]);
    least_cosine = std::min(least_cosine, through.dot(ray));
    points[i] = eye + ray * (ahead_m / through.dot(ray));
  }
  if (least_cosine < kMaxOblique || ahead_m <= 0.0) return std::nullopt;
  WindowPlace place;
  place.position_m = 0.25 * (points[0] + points[1] + points[2] + points[3]);
  const double range_m = (place.position_m - eye).norm();
  if (range_m > kFurthestM) return std::nullopt;
  const double aside_m = (place.position_m - wall.position_m).norm();
  const double off_wall_m = std::sqrt(std::pow(wall.sigma_m, 2) + std::pow(kWallSigmaM, 2) +
                                      std::pow(aside_m * wall.heading_sigma_rad, 2));
  const Eigen::Vector3d sight = (place.position_m - eye) / range_m;
  place.covariance = spread(sight, off_wall_m / least_cosine, acrossSigma(view, range_m));
  place.heading_rad = wall.heading_rad;
  place.size.width_m = 0.5 * ((points[1] - points[0]).norm() + (points[2] - points[3]).norm());
  place.size.height_m = 0.5 * ((points[3] - points[0]).norm() + (points[2] - points[1]).norm());
  place.on_wall = true;
  return place;
}

std::optional<WindowPlace> bySize(const geometry::Quadrilateral& corners, const Viewpoint& view,
                                  const geometry::OpeningSize& looked_for) {
  const geometry::Quadrilateral ideal = geometry::undistorted(corners, &view.camera);
  const double height_px = 0.5 * ((ideal[3] - ideal[0]).norm() + (ideal[2] - ideal[1]).norm());
  if (!(height_px > 1.0)) return std::nullopt;
  const double range_m = view.camera.fy * looked_for.height_m / height_px;
  if (range_m > kFurthestM) return std::nullopt;
  const Eigen::Vector3d sight = view.T_odom_camera.linear() * view.camera.ray(geometry::centroid(corners));
  WindowPlace place;
  place.position_m = view.T_odom_camera.translation() + range_m * sight;
  place.covariance = spread(sight, kRangeSigma * range_m, acrossSigma(view, range_m));
  place.heading_rad = std::atan2(sight.y(), sight.x());
  place.size = looked_for;
  return place;
}

}  // namespace

std::optional<WindowPlace> placeOf(const geometry::Quadrilateral& corners, const Viewpoint& view,
                                   const std::optional<Wall>& wall, const geometry::OpeningSize& looked_for) {
  if (!geometry::isFinite(corners)) return std::nullopt;
  if (wall)
    if (auto place = onWall(corners, view, *wall)) return place;
  return bySize(corners, view, looked_for);
}

Eigen::Isometry3d poseOf(const WindowPlace& place) {
  return geometry::makePose(geometry::yawRotation(place.heading_rad), place.position_m);
}

std::optional<geometry::Quadrilateral> inView(const WindowPlace& place, const Viewpoint& view) {
  const auto quad =
      geometry::projectOpening(view.camera, view.T_odom_camera.inverse() * poseOf(place), place.size);
  if (!quad || !geometry::isConvex(*quad)) return std::nullopt;
  const auto is_in_image = [&](const Eigen::Vector2d& corner) { return view.camera.contains(corner); };
  return std::all_of(quad->begin(), quad->end(), is_in_image) ? quad : std::nullopt;
}

double squaresBetween(const WindowPlace& a, const WindowPlace& b, double drift_m2) {
  const Eigen::Vector3d apart = a.position_m - b.position_m;
  const Eigen::Matrix3d both = a.covariance + b.covariance + drift_m2 * Eigen::Matrix3d::Identity();
  const Eigen::Vector3d weighed = both.ldlt().solve(apart);
  return apart.dot(weighed);
}

WindowPlace fused(const WindowPlace& a, const WindowPlace& b) {
  const Eigen::Matrix3d inverse_a = a.covariance.inverse(), inverse_b = b.covariance.inverse();
  double least = a.covariance.trace(), best = 1.0;
  for (const double part : {0.75, 0.5, 0.25, 0.0}) {
    const Eigen::Matrix3d mixed = (part * inverse_a + (1.0 - part) * inverse_b).inverse();
    if (mixed.trace() < least) least = mixed.trace(), best = part;
  }
  // Heading and size come from the better measured place.
  const bool by_b = b.on_wall != a.on_wall ? b.on_wall : b.covariance.trace() < a.covariance.trace();
  WindowPlace place = by_b ? b : a;
  place.covariance = (best * inverse_a + (1.0 - best) * inverse_b).inverse();
  place.position_m =
      place.covariance * (best * inverse_a * a.position_m + (1.0 - best) * inverse_b * b.position_m);
  return place;
}

}  // namespace window_ingress::facade
