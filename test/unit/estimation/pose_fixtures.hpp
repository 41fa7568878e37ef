/// Synthetic views of an opening for the tests of `pose`.
#pragma once

#include <cmath>
#include <random>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::estimation::fixtures {

inline constexpr geometry::OpeningSize kOpening{1.2, 1.0};

/// 640 x 480 with f = 381 px, 80 degrees wide.
inline geometry::PinholeCamera camera() {
  return geometry::PinholeCamera::fromFieldOfView(640, 480, 2.0 * std::atan(320.0 / 381.0));
}

inline geometry::PinholeCamera distortedCamera() {
  auto camera = fixtures::camera();
  camera.distortion = {-0.28, 0.09, 0.0007, -0.0004, -0.01};
  return camera;
}

/// A window turned by `yaw` about the vertical; its centre is straight ahead of a level camera unless given
/// otherwise.
inline Eigen::Isometry3d view(double distance_m, double yaw_rad, double right_m = 0.0, double down_m = 0.0) {
  return geometry::makePose(geometry::R_optical_flu() * geometry::yawRotation(yaw_rad),
                            {right_m, down_m, distance_m});
}

/// Corners from a perfect detector, with this stated spread, independent for each corner.
inline detection::WindowObservation cornersSeen(const geometry::PinholeCamera& camera,
                                                const Eigen::Isometry3d& T_camera_window, double sigma_px,
                                                const geometry::OpeningSize& opening = kOpening) {
  detection::WindowObservation window;
  window.corners = geometry::projectOpening(camera, T_camera_window, opening).value();
  window.corner_covariance.fill(sigma_px * sigma_px * Eigen::Matrix2d::Identity());
  return window;
}

/// Adds independent noise to the corners.
template <typename Random>
void disturb(detection::WindowObservation& window, double sigma_px, Random& random) {
  std::normal_distribution<double> noise(0.0, sigma_px);
  for (auto& corner : window.corners) corner += Eigen::Vector2d(noise(random), noise(random));
}

/// Corners as a detector that fits borders finds them: four disturbed lines with one sample a pixel, and
/// their crossings.
template <typename Random>
detection::WindowObservation bordersSeen(const geometry::PinholeCamera& camera,
                                         const Eigen::Isometry3d& T_camera_window, double sample_sigma_px,
                                         Random& random, const geometry::OpeningSize& opening = kOpening) {
  auto window = cornersSeen(camera, T_camera_window, sample_sigma_px, opening);
  std::normal_distribution<double> normal(0.0, 1.0);
  std::array<Eigen::Vector3d, 4> lines;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d a = window.corners[i], b = window.corners[(i + 1) % 4],
                          along = (b - a).normalized();
    const double length = (b - a).norm();
    auto& edge = window.edges[i];
    edge.visible = true;
    edge.sigma_px = sample_sigma_px / std::sqrt(length);
    edge.sigma_rad = edge.sigma_px * std::sqrt(12.0) / length;
    const Eigen::Vector2d across(-along.y(), along.x());
    const Eigen::Vector2d middle = 0.5 * (a + b) + edge.sigma_px * normal(random) * across;
    const Eigen::Vector2d direction = along + edge.sigma_rad * normal(random) * across;
    lines[i] = middle.homogeneous().cross((middle + length * direction).homogeneous());
  }
  for (int i = 0; i < 4; ++i) window.corners[i] = lines[(i + 3) % 4].cross(lines[i]).hnormalized();
  return window;
}

/// An estimator that uses only the stated covariances.
inline PoseParams trustingParams() {
  PoseParams params;
  params.systematic_sigma_px = 0.001;
  params.max_reprojection_rms_px = 20.0;
  return params;
}

inline double angleBetween(const Eigen::Matrix3d& a, const Eigen::Matrix3d& b) {
  return Eigen::Quaterniond(a).angularDistance(Eigen::Quaterniond(b));
}

inline constexpr double kDegree = M_PI / 180.0;

}  // namespace window_ingress::estimation::fixtures
