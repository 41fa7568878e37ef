#include <algorithm>
#include <cmath>

#include "adapters/conversions/msg_conversion.hpp"

namespace window_ingress::adapters {
namespace {

window_ingress::KnownWindow toMsg(const facade::KnownWindow& window, double now_sec) {
  window_ingress::KnownWindow message;
  message.id = window.id;
  message.pose = toPoseMsg(facade::poseOf(window.place));
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> covariance = window.place.covariance;
  std::copy(covariance.data(), covariance.data() + 9, message.position_covariance.begin());
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

window_ingress::WindowInPicture toMsg(const detection::SeenWindow& window) {
  window_ingress::WindowInPicture message;
  for (std::size_t i = 0; i < 4; ++i) {
    message.corner_x[i] = window.corners[i].x();
    message.corner_y[i] = window.corners[i].y();
  }
  message.score = window.score;
  message.has_appearance = window.has_appearance;
  message.bhattacharyya = window.bhattacharyya;
  message.is_target = window.is_target;
  message.may_be_target = window.may_be_target;
  return message;
}

std::vector<detection::SeenWindow> seenWindowsFrom(const window_ingress::WindowDetection& message) {
  std::vector<detection::SeenWindow> windows;
  for (const window_ingress::WindowInPicture& one : message.windows) {
    detection::SeenWindow window;
    for (std::size_t i = 0; i < 4; ++i) window.corners[i] = {one.corner_x[i], one.corner_y[i]};
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

void fill(window_ingress::WindowPose& message, const facade::KnownWindow& target) {
  message.window_id = target.id;
  message.remembered = toPoseMsg(facade::poseOf(target.place)).position;
}

void fill(window_ingress::WindowPose& message, const geometry::Quadrilateral& expected) {
  message.has_expected = true;
  for (std::size_t i = 0; i < 4; ++i) {
    message.expected_x[i] = expected[i].x();
    message.expected_y[i] = expected[i].y();
  }
}

window_ingress::Facade toMsg(const facade::FacadeMemory& memory, double now_sec) {
  window_ingress::Facade message;
  for (const facade::KnownWindow& window : memory.windows())
    if (memory.isShown(window)) message.windows.push_back(toMsg(window, now_sec));
  message.target_id = memory.targetId();
  message.target_chosen = memory.isChosen();
  return message;
}

}  // namespace window_ingress::adapters
