#pragma once

#include <string>

namespace window_ingress::configuration {

struct GuardParams {
  double rate_hz = 30.0;                   ///< rate of the setpoints sent to the autopilot [Hz]
  double late_sec = 0.2;                   ///< an input older than this on the steady clock is ignored [s]
  double max_speed_mps = 1.2;              ///< a faster setpoint is a fault: zero is sent [m/s]
  double max_yaw_rate_radps = 1.0;         ///< a setpoint that turns faster is a fault: zero is sent [rad/s]
  double stop_streaming_after_sec = 10.0;  ///< zeros are sent for this long after valid input stops, then
                                           ///< nothing, so that the autopilot's failsafe acts; 0: zeros
                                           ///< without end [s]
  bool lockstep = false;  ///< pass each input on at once and send nothing else; only for the simulated world
  std::string frame = "odom";  ///< frame_id of the zero setpoints sent before the first input
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 20.0, 200.0);
    field("late_sec", self.late_sec, 0.05, 1.0);
    field("max_speed_mps", self.max_speed_mps, 0.05, 10.0);
    field("max_yaw_rate_radps", self.max_yaw_rate_radps, 0.05, 5.0);
    field("stop_streaming_after_sec", self.stop_streaming_after_sec, 0.0, 3600.0);
    field("lockstep", self.lockstep);
    field("frame", self.frame);
  }
};

}  // namespace window_ingress::configuration
