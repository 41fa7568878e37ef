#include <algorithm>
#include <cmath>
#include <tuple>

#include "navigation/behaviours/behaviours.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {
namespace {
constexpr int kMaxOthers = 8;
constexpr double kMaxShiftToClimbM =
    0.3;  // beyond this correction the place is uncertain: eaves may be above
}  // namespace

Decision Search::step(const Situation& situation, MissionState& mission) {
  const auto& vehicle = *situation.vehicle;
  const double height_m = vehicle.T_odom_base.translation().z();
  if (!height_m_) height_m_ = may_climb_ ? std::max(params_->search.height_m, height_m) : height_m;
  Decision decision;
  if (situation.target && !isKnownOther(*situation.target, vehicle, mission)) {
    decision = lookAt(situation, mission);
  } else {
    frames_ = 0;
    const double fastest = fastestTurn(situation.image_period_sec);
    decision.wish.yaw_rate_radps = std::clamp(sweep(vehicle, mission), -fastest, fastest);
    decision.reason = "turn " + std::to_string(turns_ + 1) + " of " + std::to_string(params_->search.turns);
  }
  decision.keeps_place = true;
  decision.wish.velocity_odom_mps.z() =
      velocityTowards(*height_m_ - height_m, params_->search.climb_speed_mps, *params_);
  if (turns_ >= params_->search.turns || mission.others > kMaxOthers) {
    decision.event = Event::kGiveUp;
    decision.reason = "window not found in " + std::to_string(turns_) + " turns";
    if (mission.others > 0)
      decision.reason += ", but other windows " + std::to_string(mission.others) + " times";
    if (!mission.left_odom_m.empty())
      decision.reason += "; closed or given up: " + std::to_string(mission.left_odom_m.size());
  }
  return decision;
}

Decision Search::lookAt(const Situation& situation, const MissionState& mission) {
  if (situation.target_is_new) ++frames_;
  Decision decision;
  decision.wish.yaw_rate_radps =
      yawRateFor(relate(*situation.vehicle, *situation.target).bearing_rad, mission, *params_);
  decision.reason = "window in view";
  if (frames_ >= kFoundImages) decision.event = Event::kWindowFound;
  return decision;
}

double Search::fastestTurn(double image_period_sec) const {
  const auto& [search, vehicle] = std::tie(params_->search, params_->vehicle);
  double fastest = search.yaw_rate_radps;
  if (vehicle.exposure_sec > 0.0)
    fastest = std::min(fastest, search.max_blur_px * vehicle.pixel_rad / vehicle.exposure_sec);
  if (image_period_sec > 0.0)
    fastest = std::min(fastest, kMaxTurnPerImage * vehicle.horizontal_fov_rad / image_period_sec);
  return fastest;
}

double Search::sweep(const VehicleState& vehicle, MissionState& mission) {
  const double heading_rad = geometry::yawOf(vehicle.T_odom_base.linear());
  if (looks_back_ && mission.window_odom_m) {
    const Eigen::Vector3d to_window = *mission.window_odom_m - vehicle.T_odom_base.translation();
    const double bearing_rad = geometry::wrapAngle(std::atan2(to_window.y(), to_window.x()) - heading_rad);
    direction_ = bearing_rad < 0.0 ? -1.0 : 1.0;
    if (std::abs(bearing_rad) > 0.1) return yawRateFor(bearing_rad, mission, *params_);
  }
  looks_back_ = false;
  countTurn(heading_rad, mission);
  return direction_ * params_->search.yaw_rate_radps;
}

void Search::countTurn(double heading_rad, MissionState& mission) {
  if (last_heading_rad_) turned_rad_ += geometry::wrapAngle(heading_rad - *last_heading_rad_);
  last_heading_rad_ = heading_rad;
  if (std::abs(turned_rad_) < 2.0 * M_PI) return;
  turned_rad_ = 0.0;
  ++turns_;
  mission.forgetWindow();
  if (may_climb_ && mission.odometry_shift_m < kMaxShiftToClimbM)
    height_m_ = *height_m_ + params_->search.height_step_m;
}

}  // namespace window_ingress::navigation
