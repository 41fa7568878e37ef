#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters {
namespace {

using FourNumbers = decltype(window_ingress::DetectedWindow::corner_x);

void putCorners(const geometry::Quadrilateral& corners, FourNumbers& x, FourNumbers& y) {
  for (std::size_t i = 0; i < 4; ++i) {
    x[i] = corners[i].x();
    y[i] = corners[i].y();
  }
}

geometry::Quadrilateral takeCorners(const FourNumbers& x, const FourNumbers& y) {
  geometry::Quadrilateral corners;
  for (std::size_t i = 0; i < 4; ++i) corners[i] = {x[i], y[i]};
  return corners;
}

window_ingress::KnownWindow toMsg(const facade::KnownWindow& window, double now_sec) {
  window_ingress::KnownWindow message;
  message.id = window.id;
  message.pose = toPoseMsg(facade::poseOf(window.place));
  using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
  Eigen::Map<RowMajor3d>(message.position_covariance.data()) = window.place.covariance;
  message.width = window.place.size.width_m;
  message.height = window.place.size.height_m;
  message.measured = window.place.on_wall;
  message.last_seen = now_sec - window.last_seen_sec;
  message.sights = static_cast<std::uint32_t>(window.sights);
  message.score = window.score;
  message.has_appearance = window.bhattacharyya.has_value();
  message.bhattacharyya = window.bhattacharyya.value_or(0.0);
  message.may_be_target = window.may_be_target;
  message.openness = static_cast<std::uint8_t>(window.openness.openness);
  message.openness_log_odds = window.openness.log_odds;
  message.visits = static_cast<std::uint32_t>(window.visits);
  message.failures = static_cast<std::uint32_t>(window.failures);
  return message;
}

}  // namespace

window_ingress::DetectedWindow toMsg(const detection::SeenWindow& window) {
  window_ingress::DetectedWindow message;
  putCorners(window.corners, message.corner_x, message.corner_y);
  message.score = window.score;
  message.has_appearance = window.has_appearance;
  message.bhattacharyya = window.bhattacharyya;
  message.is_target = window.is_target;
  message.may_be_target = window.may_be_target;
  return message;
}

std::vector<detection::SeenWindow> seenWindowsFrom(const window_ingress::WindowDetection& message) {
  std::vector<detection::SeenWindow> windows;
  for (const window_ingress::DetectedWindow& one : message.windows) {
    detection::SeenWindow window;
    window.corners = takeCorners(one.corner_x, one.corner_y);
    const bool is_usable = geometry::isFinite(window.corners) && geometry::isConvex(window.corners) &&
                           std::isfinite(one.score) && std::isfinite(one.bhattacharyya);
    if (!is_usable || windows.size() == kMaxSeenWindows) continue;
    window.score = one.score;
    window.has_appearance = one.has_appearance != 0;
    window.bhattacharyya = one.bhattacharyya;
    window.is_target = one.is_target != 0;
    window.may_be_target = one.may_be_target != 0;
    windows.push_back(window);
  }
  return windows;
}

window_ingress::RememberedTarget targetMsg(const facade::KnownWindow* target,
                                           const std::optional<geometry::Quadrilateral>& expected) {
  window_ingress::RememberedTarget message;
  if (target) {
    message.window_id = target->id;
    message.position = toPoseMsg(facade::poseOf(target->place)).position;
  }
  message.has_expected = expected.has_value();
  if (expected) putCorners(*expected, message.expected_x, message.expected_y);
  return message;
}

std::optional<geometry::Quadrilateral> expectedFrom(const window_ingress::RememberedTarget& message) {
  const geometry::Quadrilateral expected = takeCorners(message.expected_x, message.expected_y);
  if (message.has_expected == 0 || !geometry::isFinite(expected)) return std::nullopt;
  return expected;
}

window_ingress::Facade toMsg(const facade::FacadeMemory& memory, double now_sec) {
  window_ingress::Facade message;
  for (const facade::KnownWindow& window : memory.windows())
    if (window.isConfirmed()) message.windows.push_back(toMsg(window, now_sec));
  message.target_id = memory.targetId();
  message.target_chosen = memory.isChosen();
  return message;
}

}  // namespace window_ingress::adapters
