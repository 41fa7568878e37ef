/// Limits of the setpoints: parameters below `navigator/limits` of the navigator (config/navigator.yaml).
#pragma once

namespace window_ingress::navigation {

/// What a setpoint may be, whatever a behaviour asks for.
struct LimitParams {
  double speed_mps = 1.0;                ///< largest velocity of a setpoint [m/s]
  double acceleration_mps2 = 2.0;        ///< fastest change of velocity from setpoint to setpoint [m/s^2]
  double jerk_mps3 = 30.0;               ///< fastest change of acceleration from setpoint to setpoint [m/s^3]
  double yaw_rate_radps = 0.5;           ///< largest yaw rate of a setpoint [rad/s]
  double yaw_acceleration_radps2 = 2.0;  ///< fastest change of yaw rate from setpoint to setpoint [rad/s^2]
  double min_height_m = 0.3;             ///< below this height in odom no setpoint leads down [m]
  double max_height_m = 10.0;            ///< above this height in odom no setpoint leads up [m]
  double fence_radius_m = 25.0;  ///< no setpoint leads further than this from the place of the start [m]
  double wall_distance_m = 0.9;  ///< nearer to the window's plane than this, outside the funnel, setpoints
                                 ///< lead away from it only [m]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("acceleration_mps2", self.acceleration_mps2, 0.1, 10.0);
    field("jerk_mps3", self.jerk_mps3, 0.5, 1000.0);
    field("yaw_rate_radps", self.yaw_rate_radps, 0.05, 3.0);
    field("yaw_acceleration_radps2", self.yaw_acceleration_radps2, 0.1, 20.0);
    field("min_height_m", self.min_height_m, -1000.0, 1000.0);
    field("max_height_m", self.max_height_m, -1000.0, 1000.0);
    field("fence_radius_m", self.fence_radius_m, 1.0, 10000.0);
    field("wall_distance_m", self.wall_distance_m, 0.0, 20.0);
  }
};

}  // namespace window_ingress::navigation
