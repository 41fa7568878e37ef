#pragma once

#include <optional>

#include "navigation/motion/continuous_odometry.hpp"
#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::navigation {

/// The window of the last mission, remembered beyond that mission: after a take-over, an abort or PASSED the
/// vehicle may still be in its opening or under eaves.
class FlownWindow {
 public:
  /// \param window flown at in this step, if any \param odometry source of the situation
  void follow(const std::optional<TargetEstimate>& window, const Situation& situation,
              const ContinuousOdometry& odometry);
  /// Converts the window to odom, before the jump-free frame restarts. \param now_sec time of the conversion
  void bringToOdom(const ContinuousOdometry& odometry, double now_sec);

  /// Distance of the vehicle from the opening's plane [m], either side; empty if the vehicle is clear of it.
  std::optional<double> distanceInOpening(const VehicleState& vehicle, const VehicleParams& body) const;
  /// Near the wall or behind it: eaves or a ceiling may be above.
  bool mayHaveRoofAbove(const VehicleState& vehicle) const;

 private:
  std::optional<TargetEstimate> window_;  ///< empty once the vehicle's place beside it is unknown
};

}  // namespace window_ingress::navigation
