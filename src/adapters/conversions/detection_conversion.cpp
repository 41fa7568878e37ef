#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"
#include "adapters/conversions/stamps.hpp"

namespace window_ingress::adapters {
namespace {

using DetectionMsg = window_ingress::WindowDetection;
constexpr std::size_t kMaxInteriorPoints = 1000;  // what a detector sends stays far below

// Constants of the messages are the enums of the core.
template <typename Enum>
constexpr bool same(int constant, Enum value) {
  return constant == static_cast<int>(value);
}
static_assert(same(DetectionMsg::TOP_LEFT, geometry::kTopLeft) &&
              same(DetectionMsg::TOP_RIGHT, geometry::kTopRight) &&
              same(DetectionMsg::BOTTOM_RIGHT, geometry::kBottomRight) &&
              same(DetectionMsg::BOTTOM_LEFT, geometry::kBottomLeft));
static_assert(same(DetectionMsg::TOP, geometry::kTop) && same(DetectionMsg::RIGHT, geometry::kRight) &&
              same(DetectionMsg::BOTTOM, geometry::kBottom) && same(DetectionMsg::LEFT, geometry::kLeft));

// All numbers of a detection that must be finite.
bool isFinite(const DetectionMsg& m) {
  const auto finite = [](double number) { return std::isfinite(number); };
  const auto all = [&](const auto& numbers) { return std::all_of(numbers.begin(), numbers.end(), finite); };
  return all(m.corner_x) && all(m.corner_y) && all(m.corner_covariance) && all(m.edge_sigma_px) &&
         all(m.edge_sigma_rad) && all(m.edge_a_x) && all(m.edge_a_y) && all(m.edge_b_x) && all(m.edge_b_y) &&
         finite(m.score) && finite(m.bhattacharyya) && finite(m.correlation) && finite(m.runner_up) &&
         all(m.interior_key_corner_x) && all(m.interior_key_corner_y) &&
         all(m.interior_key_corner_covariance) && finite(m.interior_sigma_px) && all(m.interior_key_x) &&
         all(m.interior_key_y) && all(m.interior_x) && all(m.interior_y) && all(m.interior_normal_x) &&
         all(m.interior_normal_y);
}

void fillCorner(DetectionMsg& message, const detection::WindowObservation& window, int i) {
  message.corner_visible[i] = true;
  message.corner_x[i] = window.corners[i].x();
  message.corner_y[i] = window.corners[i].y();
  const Eigen::Matrix<double, 2, 2, Eigen::RowMajor> covariance = window.corner_covariance[i];
  std::copy(covariance.data(), covariance.data() + 4, message.corner_covariance.begin() + 4 * i);
}

void fillEdge(DetectionMsg& message, const detection::Edge& edge, int i) {
  message.edge_visible[i] = true;
  message.edge_sigma_px[i] = edge.sigma_px;
  message.edge_sigma_rad[i] = edge.sigma_rad;
  message.edge_a_x[i] = edge.a.x();
  message.edge_a_y[i] = edge.a.y();
  message.edge_b_x[i] = edge.b.x();
  message.edge_b_y[i] = edge.b.y();
}

// What the message does not call visible stays zero, whatever it says.
void readCorner(const DetectionMsg& message, int i, detection::WindowObservation& window) {
  window.corner_visible[i] = message.corner_visible[i] != 0;
  if (!window.corner_visible[i]) return;
  window.corners[i] = {message.corner_x[i], message.corner_y[i]};
  window.corner_covariance[i] = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
      message.corner_covariance.data() + 4 * i);
}

detection::Edge readEdge(const DetectionMsg& message, int i) {
  if (message.edge_visible[i] == 0) return {};
  return {true,
          message.edge_sigma_px[i],
          message.edge_sigma_rad[i],
          {message.edge_a_x[i], message.edge_a_y[i]},
          {message.edge_b_x[i], message.edge_b_y[i]}};
}

void fillInterior(DetectionMsg& message, const detection::InteriorTracks& interior) {
  message.interior_key_stamp = toStamp(interior.key_stamp_sec);
  message.interior_sigma_px = interior.sigma_px;
  for (int i = 0; i < 4; ++i) {
    message.interior_key_corner_x[i] = interior.key_corners[i].x();
    message.interior_key_corner_y[i] = interior.key_corners[i].y();
    const Eigen::Matrix<double, 2, 2, Eigen::RowMajor> covariance = interior.key_covariance[i];
    std::copy(covariance.data(), covariance.data() + 4,
              message.interior_key_corner_covariance.begin() + 4 * i);
  }
  for (const detection::InteriorPoint& point : interior.points) {
    message.interior_id.push_back(point.id);
    message.interior_key_x.push_back(static_cast<float>(point.key_px.x()));
    message.interior_key_y.push_back(static_cast<float>(point.key_px.y()));
    message.interior_x.push_back(static_cast<float>(point.now_px.x()));
    message.interior_y.push_back(static_cast<float>(point.now_px.y()));
    message.interior_normal_x.push_back(static_cast<float>(point.normal.x()));
    message.interior_normal_y.push_back(static_cast<float>(point.normal.y()));
    message.interior_beside.push_back(point.beside);
  }
}

// None if the lists are not of one length or there is no key image.
detection::InteriorTracks readInterior(const DetectionMsg& m) {
  detection::InteriorTracks interior;
  const std::size_t points = m.interior_id.size();
  const auto key_stamp_sec = stampSec(m.interior_key_stamp);
  if (points == 0 || !key_stamp_sec || m.interior_key_x.size() != points ||
      m.interior_key_y.size() != points || m.interior_x.size() != points || m.interior_y.size() != points ||
      m.interior_normal_x.size() != points || m.interior_normal_y.size() != points ||
      m.interior_beside.size() != points)
    return interior;
  interior.key_stamp_sec = *key_stamp_sec;
  interior.sigma_px = m.interior_sigma_px;
  for (int i = 0; i < 4; ++i) {
    interior.key_corners[i] = {m.interior_key_corner_x[i], m.interior_key_corner_y[i]};
    interior.key_covariance[i] = Eigen::Map<const Eigen::Matrix<double, 2, 2, Eigen::RowMajor>>(
        m.interior_key_corner_covariance.data() + 4 * i);
  }
  for (std::size_t i = 0; i < points; ++i)
    interior.points.push_back({m.interior_id[i],
                               {m.interior_key_x[i], m.interior_key_y[i]},
                               {m.interior_x[i], m.interior_y[i]},
                               {m.interior_normal_x[i], m.interior_normal_y[i]},
                               m.interior_beside[i]});
  return interior;
}

}  // namespace

DetectionMsg toMsg(const detection::WindowObservation& window) {
  DetectionMsg message;
  message.detected = true;
  message.target_id = window.target_id;
  for (int i = 0; i < 4; ++i) {
    if (window.corner_visible[i]) fillCorner(message, window, i);
    if (window.edges[i].visible) fillEdge(message, window.edges[i], i);
  }
  message.score = window.score;
  message.has_appearance = window.has_appearance;
  message.bhattacharyya = window.has_appearance ? window.bhattacharyya : 0.0;
  message.correlation = window.correlation;
  message.runner_up = window.runner_up;
  if (!window.interior.empty()) fillInterior(message, window.interior);
  return message;
}

Converted<detection::WindowObservation> fromMsg(const DetectionMsg& message) {
  const auto stamp_sec = stampSec(message.header.stamp);
  if (!stamp_sec) return {std::nullopt, "header.stamp is zero or not normalised"};
  if (!message.detected) return {std::nullopt, "no window: " + message.reject_reason};
  if (message.interior_id.size() > kMaxInteriorPoints)
    return {std::nullopt, std::to_string(message.interior_id.size()) +
                              " points within the opening, at most " + std::to_string(kMaxInteriorPoints) +
                              " are taken"};
  if (!isFinite(message)) return {std::nullopt, "a number of the detection is not finite"};
  detection::WindowObservation window;
  window.stamp_sec = *stamp_sec;
  for (int i = 0; i < 4; ++i) {
    readCorner(message, i, window);
    window.edges[i] = readEdge(message, i);
  }
  window.target_id = message.target_id;
  window.score = message.score;
  window.has_appearance = message.has_appearance != 0;
  window.bhattacharyya = message.bhattacharyya;
  window.correlation = message.correlation;
  window.runner_up = message.runner_up;
  window.interior = readInterior(message);
  return {window, ""};
}

}  // namespace window_ingress::adapters
