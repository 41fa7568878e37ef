#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::adapters {
namespace {

using DetectionMsg = window_ingress::WindowDetection;
using RowMajor2d = Eigen::Matrix<double, 2, 2, Eigen::RowMajor>;
constexpr std::size_t kMaxInteriorPoints = 1000;  // far above what a detector sends

template <typename Numbers>
bool allFinite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

bool isFinite(const window_ingress::WindowCorner& m) {
  return std::isfinite(m.x) && std::isfinite(m.y) && allFinite(m.covariance);
}

bool isFinite(const window_ingress::WindowEdge& m) {
  return std::isfinite(m.sigma_px) && std::isfinite(m.sigma_rad) && std::isfinite(m.a_x) &&
         std::isfinite(m.a_y) && std::isfinite(m.b_x) && std::isfinite(m.b_y);
}

template <typename Parts>
bool areFinite(const Parts& parts) {
  return std::all_of(parts.begin(), parts.end(), [](const auto& part) { return isFinite(part); });
}

bool isFinite(const window_ingress::InteriorPoints& m) {
  return areFinite(m.key_corners) && std::isfinite(m.sigma_px) && allFinite(m.key_x) && allFinite(m.key_y) &&
         allFinite(m.x) && allFinite(m.y) && allFinite(m.normal_x) && allFinite(m.normal_y);
}

bool isFinite(const DetectionMsg& m) {
  return areFinite(m.corners) && areFinite(m.edges) && std::isfinite(m.score) &&
         std::isfinite(m.appearance.bhattacharyya) && std::isfinite(m.appearance.correlation) &&
         std::isfinite(m.appearance.runner_up) && isFinite(m.interior);
}

window_ingress::WindowCorner cornerMsg(const Eigen::Vector2d& corner, const Eigen::Matrix2d& covariance) {
  window_ingress::WindowCorner message;
  message.visible = true;
  message.x = corner.x();
  message.y = corner.y();
  Eigen::Map<RowMajor2d>(message.covariance.data()) = covariance;
  return message;
}

window_ingress::WindowEdge toMsg(const detection::Edge& edge) {
  window_ingress::WindowEdge message;
  if (!edge.visible) return message;
  message.visible = true;
  message.sigma_px = edge.sigma_px;
  message.sigma_rad = edge.sigma_rad;
  message.a_x = edge.a.x();
  message.a_y = edge.a.y();
  message.b_x = edge.b.x();
  message.b_y = edge.b.y();
  return message;
}

window_ingress::WindowAppearance appearanceMsg(const detection::WindowObservation& window) {
  window_ingress::WindowAppearance message;
  message.compared = window.has_appearance;
  message.bhattacharyya = window.has_appearance ? window.bhattacharyya : 0.0;
  message.correlation = window.correlation;
  message.runner_up = window.runner_up;
  return message;
}

// A corner that the message marks as invisible stays zero, whatever its numbers.
bool readCorner(const window_ingress::WindowCorner& message, Eigen::Vector2d& corner,
                Eigen::Matrix2d& covariance) {
  if (message.visible == 0) return false;
  corner = {message.x, message.y};
  covariance = Eigen::Map<const RowMajor2d>(message.covariance.data());
  return true;
}

detection::Edge fromMsg(const window_ingress::WindowEdge& message) {
  if (message.visible == 0) return {};
  return {true, message.sigma_px, message.sigma_rad, {message.a_x, message.a_y}, {message.b_x, message.b_y}};
}

}  // namespace

window_ingress::InteriorPoints toMsg(const detection::InteriorTracks& interior) {
  window_ingress::InteriorPoints message;
  if (interior.empty()) return message;
  message.key_stamp = toStamp(interior.key_stamp_sec);
  message.sigma_px = interior.sigma_px;
  for (int i = 0; i < 4; ++i)
    message.key_corners[i] = cornerMsg(interior.key_corners[i], interior.key_covariance[i]);
  for (const detection::InteriorPoint& point : interior.points) {
    message.id.push_back(point.id);
    message.key_x.push_back(static_cast<float>(point.key_px.x()));
    message.key_y.push_back(static_cast<float>(point.key_px.y()));
    message.x.push_back(static_cast<float>(point.now_px.x()));
    message.y.push_back(static_cast<float>(point.now_px.y()));
    message.normal_x.push_back(static_cast<float>(point.normal.x()));
    message.normal_y.push_back(static_cast<float>(point.normal.y()));
    message.beside.push_back(point.beside);
  }
  return message;
}

detection::InteriorTracks fromMsg(const window_ingress::InteriorPoints& m) {
  detection::InteriorTracks interior;
  const std::size_t points = m.id.size();
  for (const std::size_t size : {m.key_x.size(), m.key_y.size(), m.x.size(), m.y.size(), m.normal_x.size(),
                                 m.normal_y.size(), m.beside.size()})
    if (size != points) return {};
  const auto key_stamp_sec = stampSec(m.key_stamp);
  if (!key_stamp_sec) return {};
  interior.key_stamp_sec = *key_stamp_sec;
  interior.sigma_px = m.sigma_px;
  for (int i = 0; i < 4; ++i)
    if (!readCorner(m.key_corners[i], interior.key_corners[i], interior.key_covariance[i])) return {};
  for (std::size_t i = 0; i < points; ++i)
    interior.points.push_back(
        {m.id[i], {m.key_x[i], m.key_y[i]}, {m.x[i], m.y[i]}, {m.normal_x[i], m.normal_y[i]}, m.beside[i]});
  return interior;
}

DetectionMsg toMsg(const detection::WindowObservation& window) {
  DetectionMsg message;
  message.detected = true;
  message.target_id = window.target_id;
  for (int i = 0; i < 4; ++i) {
    if (window.corner_visible[i])
      message.corners[i] = cornerMsg(window.corners[i], window.corner_covariance[i]);
    message.edges[i] = toMsg(window.edges[i]);
  }
  message.score = window.score;
  message.appearance = appearanceMsg(window);
  message.interior = toMsg(window.interior);
  return message;
}

Converted<detection::WindowObservation> fromMsg(const DetectionMsg& message) {
  const auto stamp_sec = stampSec(message.header.stamp);
  if (!stamp_sec) return {std::nullopt, "header.stamp is zero or not normalised"};
  if (!message.detected) return {std::nullopt, "no window: " + message.reason};
  if (message.interior.id.size() > kMaxInteriorPoints)
    return {std::nullopt, formatted("%zu points within the opening, at most %zu are taken",
                                    message.interior.id.size(), kMaxInteriorPoints)};
  if (!isFinite(message)) return {std::nullopt, "a number of the detection is not finite"};
  detection::WindowObservation window;
  window.stamp_sec = *stamp_sec;
  for (int i = 0; i < 4; ++i) {
    window.corner_visible[i] = readCorner(message.corners[i], window.corners[i], window.corner_covariance[i]);
    window.edges[i] = fromMsg(message.edges[i]);
  }
  window.target_id = message.target_id;
  window.score = message.score;
  window.has_appearance = message.appearance.compared != 0;
  window.bhattacharyya = message.appearance.bhattacharyya;
  window.correlation = message.appearance.correlation;
  window.runner_up = message.appearance.runner_up;
  window.interior = fromMsg(message.interior);
  return {window, ""};
}

DetectionMsg toMsg(const detection::DetectionTrace& trace) {
  DetectionMsg message;
  message.reject = static_cast<std::uint8_t>(trace.outcome);
  message.reason = trace.detail;
  return message;
}

}  // namespace window_ingress::adapters
