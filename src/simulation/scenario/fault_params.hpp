/// Faults of a world and their times; doc/scenarios.md has the table of the effect of each kind on each unit.
#pragma once

#include <string>

namespace window_ingress::simulation {

/// One temporary fault.
struct FaultParams {
  std::string unit = "image";  ///< part of the world with the fault
  std::string kind = "off";    ///< what the fault does to the unit
  double at_sec = 5.0;         ///< start of the fault, in the world's time [s]
  double duration_sec = 2.0;   ///< duration of the fault [s]
  double rate_hz = 1.0;        ///< slow: remaining samples per second [1/s]
  double delay_sec = 1.0;      ///< delayed: additional delay of every sample [s]
  double off_sec = 0.5;        ///< intermittent: length of each gap; a gap comes first [s]
  double on_sec = 0.5;         ///< intermittent: length of normal operation after each gap [s]
  double jump_m = 4.0;         ///< wrong odom, tf: error of the position along the frame's x [m]
  double slide_mps =
      0.5;  ///< slide: speed at which the position drifts, while the velocity shows none of it [m/s]
  double direction_rad = 0.0;   ///< slide: direction of the drift, from the frame's x towards its y [rad]
  double turn_rad = 1.5707963;  ///< wrong odom, tf: error of the heading [rad]
  double tilt_rad = 0.5;        ///< wrong imu: error of the attitude, in roll [rad]
  double zoom = 1.3;            ///< wrong camera_info: factor on the focal lengths
  double back_sec = 5.0;        ///< wrong clock: delay of the clock [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("unit", self.unit, {"image", "camera_info", "odom", "imu", "tf", "clock", "cmd_vel"});
    field.choice("kind", self.kind,
                 {"off", "stuck", "garbage", "wrong", "slow", "delayed", "intermittent", "slide"});
    field("at_sec", self.at_sec, 0.0, 3600.0);
    field("duration_sec", self.duration_sec, 0.01, 3600.0);
    field("rate_hz", self.rate_hz, 0.1, 100.0);
    field("delay_sec", self.delay_sec, 0.01, 10.0);
    field("off_sec", self.off_sec, 0.01, 60.0);
    field("on_sec", self.on_sec, 0.01, 60.0);
    field("jump_m", self.jump_m, -100.0, 100.0);
    field("slide_mps", self.slide_mps, 0.0, 50.0);
    field("direction_rad", self.direction_rad, -3.15, 3.15);
    field("turn_rad", self.turn_rad, -3.15, 3.15);
    field("tilt_rad", self.tilt_rad, -3.15, 3.15);
    field("zoom", self.zoom, 0.1, 10.0);
    field("back_sec", self.back_sec, 0.01, 100.0);
  }
};

/// Why this fault is impossible: the kind has no useful effect on the unit. Empty if it is possible.
std::string whyNoSuchFault(const FaultParams& fault);
/// As above, for an external vehicle, whose data does not come from this world.
std::string whyNotBesideExternalVehicle(const FaultParams& fault);

}  // namespace window_ingress::simulation
