#include "estimation/planar/observation_check.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

using detection::WindowObservation;

constexpr double kMinSidePx = 4.0;
constexpr double kMinCornerAngleRad = 0.15;  // interior angles stay this far from 0 and pi

bool isNearImage(const geometry::Quadrilateral& corners, const geometry::PinholeCamera& camera) {
  const double margin = std::max(camera.width, camera.height);
  return std::all_of(corners.begin(), corners.end(),
                     [&](const auto& p) { return camera.contains(p, -margin); });
}

std::string missingSides(const WindowObservation& window) {
  static const char* const kNames[] = {"top", "right", "bottom", "left"};
  std::string unseen;
  for (int i = 0; i < 4; ++i)
    if (!window.edges[i].visible) unseen += std::string(unseen.empty() ? "" : ", ") + kNames[i];
  return std::to_string(window.visibleSides()) + " of 4 sides in view: " + unseen +
         " not seen; no pose from this image alone";
}

std::string faultOfPartial(const WindowObservation& window, const geometry::PinholeCamera& camera) {
  if (window.visibleSides() < 4) return missingSides(window);
  const double margin = std::max(camera.width, camera.height);
  for (const auto& edge : window.edges) {
    if (!edge.a.allFinite() || !edge.b.allFinite()) return "a border's end is not finite";
    if (!camera.contains(edge.a, -margin) || !camera.contains(edge.b, -margin))
      return "a border's end lies more than an image's size outside the image";
    const double length = (edge.b - edge.a).norm();
    if (length < kMinSidePx) return formatted("border of %.2f px < %.2f px", length, kMinSidePx);
  }
  return "";
}

}  // namespace

bool isUpright(const WindowObservation& window, const Eigen::Vector3d& up_camera) {
  if (window.whole()) return true;
  return -up_camera.y() > up_camera.head<2>().norm() * std::sqrt(0.5);
}

std::string faultOfCorners(const WindowObservation& window, const geometry::PinholeCamera& camera) {
  if (!window.whole()) return faultOfPartial(window, camera);
  if (!geometry::isFinite(window.corners)) return "a corner is not finite";
  if (!isNearImage(window.corners, camera))
    return "a corner lies more than an image's size outside the image";
  if (!geometry::isConvex(window.corners)) return "corners coincide, cross or are not convex";
  const auto lengths = geometry::sideLengths(window.corners);
  const double shortest = *std::min_element(lengths.begin(), lengths.end());
  if (shortest < kMinSidePx) return formatted("side of %.2f px < %.2f px", shortest, kMinSidePx);
  for (const double angle : geometry::interiorAngles(window.corners))
    if (angle < kMinCornerAngleRad || angle > M_PI - kMinCornerAngleRad)
      return formatted("corner of %.3f rad is within %.3f rad of 0 or pi", angle, kMinCornerAngleRad);
  const int visible = window.visibleSides();
  if (visible > 0 && visible < 4) return formatted("only %d of 4 borders are seen", visible);
  return "";
}

WindowObservation upright(const WindowObservation& window, const Eigen::Vector3d& up_camera) {
  if (!window.whole()) return window;
  const bool is_reversed = geometry::signedArea(window.corners) < 0.0;
  const auto clockwise = [&](int i) { return is_reversed ? 3 - i % 4 : i % 4; };
  const auto height = [&](int first) {
    const auto corner = [&](int i) -> const Eigen::Vector2d& { return window.corners[clockwise(first + i)]; };
    return (corner(0) + corner(1) - corner(2) - corner(3)).dot(up_camera.head<2>());
  };
  int best = 0;
  for (int first = 1; first < 4; ++first)
    if (height(first) > height(best)) best = first;
  WindowObservation out = window;
  for (int i = 0; i < 4; ++i) {
    const int from = clockwise(best + i);
    out.corners[i] = window.corners[from];
    out.corner_covariance[i] = window.corner_covariance[from];
    out.edges[i] = window.edges[is_reversed ? (from + 3) % 4 : from];  // between corner i and the next
  }
  return out;
}

}  // namespace window_ingress::estimation
