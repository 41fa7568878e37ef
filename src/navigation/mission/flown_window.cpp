#include "navigation/mission/flown_window.hpp"

#include <cmath>

#include "window_ingress/navigation/relative_state.hpp"

namespace window_ingress::navigation {
namespace {

constexpr double kLostM = 1.0;        // with a larger correction of odometry the vehicle's place is unknown
constexpr double kRoomToTurnM = 0.3;  // beside a turning body
constexpr double kEavesM = 2.5;       // distance from the wall

}  // namespace

void FlownWindow::follow(const std::optional<TargetEstimate>& window, const Situation& situation,
                         const ContinuousOdometry& odometry) {
  if (window) window_ = window;
  if (situation.vehicle_jumped || odometry.shiftM() > kLostM) window_.reset();
}

void FlownWindow::bringToOdom(const ContinuousOdometry& odometry, double now_sec) {
  if (window_) window_->T_odom_window = odometry.T_smooth_odom(now_sec).inverse() * window_->T_odom_window;
}

std::optional<double> FlownWindow::distanceInOpening(const VehicleState& vehicle,
                                                     const VehicleParams& body) const {
  if (!window_) return std::nullopt;
  const Eigen::Vector3d place_m = relate(vehicle, *window_).position_window_m;
  const double clear_m = std::hypot(body.half_length_m, body.half_width_m) + kRoomToTurnM;
  const double aside_m = std::abs(place_m.y()) - 0.5 * window_->opening.width_m;
  if (std::abs(place_m.x()) > clear_m || aside_m > clear_m) return std::nullopt;
  return std::abs(place_m.x());
}

bool FlownWindow::mayHaveRoofAbove(const VehicleState& vehicle) const {
  return window_ && relate(vehicle, *window_).distance() < kEavesM;
}

}  // namespace window_ingress::navigation
