#pragma once

#include <string>

#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::configuration {

/// The topic `engaged`: whether the autopilot follows setpoints.
struct EngagementParams {
  bool required = false;  ///< no mission starts before `engaged` reports that the vehicle follows setpoints
  double max_silence_sec = 3.0;  ///< the mission ends if `engaged` falls silent for longer than this [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 60.0);
  }
};

/// The topic `passed_on`: whether the guard passes setpoints on to the autopilot.
struct GuardMonitorParams {
  bool required = false;          ///< no mission starts before the guard has passed on a setpoint
  double max_silence_sec = 0.25;  ///< a guard silent for longer than this counts as passing nothing on [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 5.0);
  }
};

struct NavigatorNodeParams {
  double rate_hz = 30.0;                ///< rate of the setpoints [Hz]
  double max_silence_sec = 0.25;        ///< odometry is lost after this long without a message (steady clock)
                                        ///< [s]
  std::string setpoint_frame = "odom";  ///< axes of the setpoints, whatever names these frames have
  bool lockstep = false;                ///< run step by step with the simulated world; only with use_sim_time
  bool start_at_once = false;  ///< start the mission at the first step that allows it; only in lockstep
  EngagementParams engagement;
  GuardMonitorParams guard;
  navigation::NavigatorParams navigator;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 20.0, 200.0);
    field("max_silence_sec", self.max_silence_sec, 0.05, 5.0);
    field.choice("setpoint_frame", self.setpoint_frame, {"odom", "base_link"});
    field("lockstep", self.lockstep);
    field("start_at_once", self.start_at_once);
    field.group("engagement", self.engagement);
    field.group("guard", self.guard);
    field.group("navigator", self.navigator);
  }
};

}  // namespace window_ingress::configuration
