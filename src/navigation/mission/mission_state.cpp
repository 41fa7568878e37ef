#include "navigation/mission/mission_state.hpp"

namespace window_ingress::navigation {

void MissionState::leaveWindow() {
  trusted.reset();
  window_odom_m.reset();
  opening_asked = opening_confirmed = false;
}

void MissionState::giveUpWindow(const TargetEstimate& window) {
  left_odom_m.push_back(window.T_odom_window.translation());
  if (window.window_id != 0) given_up.push_back(window.window_id);
  leaveWindow();
}

void MissionState::forgetWindow() {
  leaveWindow();
  others_odom_m.clear();
}

void MissionState::forgetPlaces() {
  forgetWindow();
  committed.reset();
  left_odom_m.clear();
  home_odom_m.reset();
  place_odom_m.reset();
  keeping_since_sec.reset();
}

void MissionState::followVehicle(const Eigen::Vector3d& position_odom_m, const Eigen::Vector3d& carried_m) {
  if (!home_odom_m) home_odom_m = position_odom_m - from_home_m;
  from_home_m = position_odom_m - *home_odom_m;
  if (place_odom_m) *place_odom_m += carried_m - place_carried_m;
  place_carried_m = carried_m;
}

}  // namespace window_ingress::navigation
