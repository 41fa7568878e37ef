/// What goes wrong in a world, and when; doc/scenarios.md has the table of what each kind does to each unit.
#pragma once

#include <string>

namespace window_ingress::simulation {

/// One thing that goes wrong for a while.
struct FaultParams {
  std::string unit = "image";  ///< what is hit
  std::string kind = "off";    ///< what happens to it
  double at_sec = 5.0;         ///< when it begins, in time of the world [s]
  double duration_sec = 2.0;   ///< how long it lasts [s]
  double rate_hz = 1.0;        ///< slow: so many samples a second are left [1/s]
  double delay_sec = 1.0;      ///< delayed: how much later everything arrives [s]
  double off_sec = 0.5;        ///< intermittent: so long nothing, first [s]
  double on_sec = 0.5;         ///< intermittent: then so long as if nothing were wrong [s]
  double jump_m = 4.0;         ///< wrong odom, tf: the position is off by this along the frame's x [m]
  double slide_mps =
      0.5;  ///< slide: the position moves off at this speed, the velocity knows nothing of it [m/s]
  double direction_rad = 0.0;   ///< slide: where to, from the frame's x towards its y [rad]
  double turn_rad = 1.5707963;  ///< wrong odom, tf: the heading is off by this [rad]
  double tilt_rad = 0.5;        ///< wrong imu: the attitude is rolled by this [rad]
  double zoom = 1.3;            ///< wrong camera_info: focal lengths times this
  double back_sec = 5.0;        ///< wrong clock: it is behind by this [s]
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

/// Why there can be no such fault: a unit that this kind does nothing sensible to; empty if there can.
std::string whyNoSuchFault(const FaultParams& fault);
/// The same where the vehicle is simulated elsewhere, and its data with it.
std::string whyNotBesideExternalVehicle(const FaultParams& fault);

}  // namespace window_ingress::simulation
