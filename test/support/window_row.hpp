/// Windows side by side in a wall, as a vehicle sees them; for tests of the façade memory.
#pragma once

#include <optional>
#include <random>

#include "window_ingress/detection/seen_windows.hpp"
#include "window_ingress/facade/facade_memory.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::test {

/// Equal windows in the plane x = 0 of odom, 1.5 m high; window i is at y = -spacing * i. The camera looks
/// along x, turned by its heading.
struct WindowRow {
  int count = 5;
  double spacing_m = 1.9;
  geometry::OpeningSize size{1.2, 1.0};
  double noise_px = 0.7;

  Eigen::Vector3d centre(int i) const { return {0.0, -spacing_m * i, 1.5}; }

  static facade::Viewpoint from(const Eigen::Vector3d& position_m, double heading_rad = 0.0) {
    facade::Viewpoint view;
    view.camera = geometry::PinholeCamera::fromFieldOfView(640, 480, 1.2);
    view.T_odom_camera = geometry::makePose(
        geometry::yawRotation(heading_rad) * geometry::R_optical_flu().transpose(), position_m);
    return view;
  }

  /// Nothing if the window is not wholly in view.
  std::optional<detection::SeenWindow> seen(int i, const facade::Viewpoint& view,
                                            std::mt19937& random) const {
    const Eigen::Isometry3d T_odom_window = geometry::makePose(Eigen::Matrix3d::Identity(), centre(i));
    auto quad = geometry::projectOpening(view.camera, view.T_odom_camera.inverse() * T_odom_window, size);
    if (!quad) return std::nullopt;
    for (const Eigen::Vector2d& corner : *quad)
      if (!view.camera.contains(corner)) return std::nullopt;
    std::normal_distribution<double> noise(0.0, noise_px);
    detection::SeenWindow window;
    window.corners = *quad;
    for (Eigen::Vector2d& corner : window.corners) corner += Eigen::Vector2d(noise(random), noise(random));
    window.score = 0.8;
    window.may_be_target = true;
    return window;
  }

  /// All windows in view. \param target index in the row of the tracked window, -1: none
  facade::FacadeView look(double stamp_sec, const facade::Viewpoint& view, int target,
                          std::mt19937& random) const {
    facade::FacadeView look{stamp_sec, view, {}, 0};
    for (int i = 0; i < count; ++i) {
      auto window = seen(i, view, random);
      if (!window) continue;
      window->is_target = i == target;
      if (window->is_target) look.track_id = static_cast<std::uint32_t>(i) + 1;
      look.windows.push_back(*window);
    }
    return look;
  }

  /// Estimate of a window by a filter that has converged.
  facade::TrackedWindow tracked(int i) const {
    return {geometry::makePose(Eigen::Matrix3d::Identity(), centre(i)),
            1e-4 * Eigen::Matrix<double, 6, 6>::Identity(), size, true, 100};
  }

  detection::WindowObservation observation(int i, double stamp_sec, const facade::Viewpoint& view,
                                           std::mt19937& random) const {
    detection::WindowObservation window;
    window.stamp_sec = stamp_sec;
    window.corners = seen(i, view, random).value().corners;
    window.target_id = static_cast<std::uint32_t>(i) + 1;
    return window;
  }
};

}  // namespace window_ingress::test
