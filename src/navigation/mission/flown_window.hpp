#pragma once

#include <cmath>
#include <optional>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation {

/// The window of the last mission, remembered beyond that mission: after a take-over, an abort or PASSED the
/// vehicle may still be in its opening or under eaves.
class FlownWindow {
 public:
  /// \param window flown at in this step, if any \param odometry source of the situation
  void follow(const std::optional<TargetEstimate>& window, const Situation& situation,
              const ContinuousOdometry& odometry) {
    if (window) window_ = window;
    if (situation.vehicle_jumped || odometry.shiftM() > kLostM) window_.reset();
  }
  /// Converts the window to odom, before the jump-free frame restarts. \param now_sec time of the conversion
  void bringToOdom(const ContinuousOdometry& odometry, double now_sec) {
    if (window_) window_->T_odom_window = odometry.T_smooth_odom(now_sec).inverse() * window_->T_odom_window;
  }

  /// Distance of the vehicle from the opening's plane [m], either side; empty if the vehicle is clear of it.
  std::optional<double> distanceInOpening(const VehicleState& vehicle, const VehicleParams& body) const {
    if (!window_) return std::nullopt;
    const RelativeState relative = relate(vehicle, *window_);
    const double distance_m = std::abs(relative.distance());
    const double clear_m = std::hypot(body.half_length_m, body.half_width_m) + kRoomToTurnM;
    const double aside_m = std::abs(relative.lateral()) - 0.5 * window_->opening.width_m;
    return distance_m > clear_m || aside_m > clear_m ? std::nullopt : std::optional(distance_m);
  }
  /// Near the wall or behind it: eaves or a ceiling may be above.
  bool mayHaveRoofAbove(const VehicleState& vehicle) const {
    return window_ && relate(vehicle, *window_).distance() < kEavesM;
  }

 private:
  static constexpr double kLostM =
      1.0;  ///< with a larger correction of odometry the vehicle's place is unknown
  static constexpr double kRoomToTurnM = 0.3;  ///< beside a turning body
  static constexpr double kEavesM = 2.5;       ///< distance from the wall
  std::optional<TargetEstimate> window_;       ///< empty once the vehicle's place beside it is unknown
};

}  // namespace window_ingress::navigation
