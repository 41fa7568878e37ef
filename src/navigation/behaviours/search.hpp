#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "navigation/behaviours/behaviour.hpp"
#include "navigation/mission/window_choice.hpp"
#include "navigation/motion/axis_guidance.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::navigation {

/// SEARCH (P14): turns in place, first towards the last known place of the window. After each unsuccessful
/// turn the vehicle climbs. It moves nowhere else. Once a window is seen, the vehicle turns towards it until
/// enough images have shown it.
class Search : public Behaviour {
 public:
  static constexpr double kMaxTurnPerImage = 0.25;  ///< fraction of the field of view between two images

  /// \param may_climb false once a mission has been near the window: the space above may not be free
  Search(const NavigatorParams& params, bool may_climb) : Behaviour(params), may_climb_(may_climb) {}

  Decision step(const Situation& situation, MissionState& mission) override {
    const double height_m = situation.vehicle->T_odom_base.translation().z();
    if (!height_m_) height_m_ = may_climb_ ? std::max(params_->search.height_m, height_m) : height_m;
    Decision decision;
    if (situation.target && !isKnownOther(*situation.target, *situation.vehicle, mission)) {
      lookAt(situation, decision);
    } else {
      frames_ = 0;
      const double fastest = fastestTurn(situation.image_period_sec);
      decision.wish.yaw_rate_radps = std::clamp(sweep(situation, mission), -fastest, fastest);
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

 private:
  static constexpr int kMaxOthers = 4;
  /// Beyond this correction of odometry the place is uncertain: eaves may be above.
  static constexpr double kMaxShiftToClimbM = 0.3;

  void lookAt(const Situation& situation, Decision& decision) {
    if (situation.target_is_new) ++frames_;
    decision.wish.yaw_rate_radps =
        yawRateFor(relate(*situation.vehicle, *situation.target).bearing_rad, situation, *params_);
    decision.reason = "window in view";
    if (frames_ >= kFoundImages) decision.event = Event::kWindowFound;
  }

  /// Fastest yaw rate [rad/s] without blur and without skipping a window between two images (trap: faster
  /// finds less).
  double fastestTurn(double image_period_sec) const {
    const auto& search = params_->search;
    const auto& vehicle = params_->vehicle;
    double fastest = search.yaw_rate_radps;
    if (vehicle.exposure_sec > 0.0)
      fastest = std::min(fastest, search.max_blur_px * vehicle.camera.pixel_rad / vehicle.exposure_sec);
    if (image_period_sec > 0.0)
      fastest = std::min(fastest, kMaxTurnPerImage * vehicle.camera.horizontal_fov_rad / image_period_sec);
    return fastest;
  }

  double sweep(const Situation& situation, MissionState& mission) {
    const Eigen::Isometry3d& T_odom_base = situation.vehicle->T_odom_base;
    const double heading_rad = geometry::yawOf(T_odom_base.linear());
    if (looks_back_ && mission.window_odom_m) {
      const Eigen::Vector3d to_window = *mission.window_odom_m - T_odom_base.translation();
      const double bearing_rad = geometry::wrapAngle(std::atan2(to_window.y(), to_window.x()) - heading_rad);
      direction_ = bearing_rad < 0.0 ? -1.0 : 1.0;
      if (std::abs(bearing_rad) > 0.1) return yawRateFor(bearing_rad, situation, *params_);
    }
    looks_back_ = false;
    if (last_heading_rad_) turned_rad_ += geometry::wrapAngle(heading_rad - *last_heading_rad_);
    last_heading_rad_ = heading_rad;
    if (std::abs(turned_rad_) >= 2.0 * M_PI) {
      turned_rad_ = 0.0;
      ++turns_;
      mission.forgetWindow();
      if (may_climb_ && situation.odometry.shift_m < kMaxShiftToClimbM)
        *height_m_ += params_->search.height_step_m;
    }
    return direction_ * params_->search.yaw_rate_radps;
  }

  bool may_climb_;
  std::optional<double> height_m_;
  std::optional<double> last_heading_rad_;
  double turned_rad_ = 0.0;
  double direction_ = 1.0;
  bool looks_back_ = true;
  int turns_ = 0;
  int frames_ = 0;
};

}  // namespace window_ingress::navigation
