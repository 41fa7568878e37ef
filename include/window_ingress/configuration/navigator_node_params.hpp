#pragma once

#include <string>

#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::configuration {

/// The autopilot's word on `engaged` that it follows setpoints.
struct EngagementParams {
  bool required = false;  ///< no mission starts before somebody has said that the vehicle follows setpoints
  double max_silence_sec = 3.0;  ///< once said, it must be repeated within this time, or the mission ends [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 60.0);
  }
};

/// The guard's word on `passed_on` that setpoints reach the autopilot.
struct GuardMonitorParams {
  bool required = false;          ///< no mission starts before the guard has passed something on
  double max_silence_sec = 0.25;  ///< a guard that is silent for longer than this passes nothing on [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 5.0);
  }
};

struct NavigatorNodeParams {
  double rate_hz = 30.0;          ///< rate of the setpoints [Hz]
  double max_silence_sec = 0.25;  ///< odometry that has not arrived for this long, on the steady clock, is
                                  ///< gone [s]
  double max_pose_silence_sec = 1.5;  ///< messages on window_pose that have not arrived for this long, on the
                                      ///< steady clock, are gone [s]
  std::string setpoint_frame = "odom";  ///< axes of the setpoints, whatever these frames are called
  bool lockstep = false;                ///< run step by step with the simulated world; only with use_sim_time
  bool start_at_once = false;  ///< start the mission with the first step at which it may; only in lockstep
  EngagementParams engagement;
  GuardMonitorParams guard;
  navigation::NavigatorParams navigator;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 20.0, 200.0);
    field("max_silence_sec", self.max_silence_sec, 0.05, 5.0);
    field("max_pose_silence_sec", self.max_pose_silence_sec, 0.05, 5.0);
    field.choice("setpoint_frame", self.setpoint_frame, {"odom", "base_link"});
    field("lockstep", self.lockstep);
    field("start_at_once", self.start_at_once);
    field.group("engagement", self.engagement);
    field.group("guard", self.guard);
    field.group("navigator", self.navigator);
  }
};

}  // namespace window_ingress::configuration
