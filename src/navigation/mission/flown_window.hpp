#pragma once

#include <optional>

#include "navigation/motion/continuous_odometry.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// The window that the last mission flew at, beyond that mission: after a take-over, an abort or PASSED the
/// vehicle may still be in its opening, or under what is above it.
class FlownWindow {
 public:
  /// \param window flown at in this step, if one is \param odometry that the situation is from
  void follow(const std::optional<TargetEstimate>& window, const Situation& situation,
              const ContinuousOdometry& odometry);
  /// From the frame without jumps into odom, before that frame begins anew. \param now_sec as of then
  void bringToOdom(const ContinuousOdometry& odometry, double now_sec);

  /// Of a vehicle in the opening, before its plane or behind it [m]; nothing where it is clear of it.
  std::optional<double> distanceInOpening(const VehicleState& vehicle, const VehicleParams& body) const;
  /// Near the wall, or behind it: what is above may be eaves or a ceiling.
  bool mayHaveRoofAbove(const VehicleState& vehicle) const;

 private:
  std::optional<TargetEstimate> window_;  ///< as long as it is known where the vehicle is beside it
};

}  // namespace window_ingress::navigation
