#pragma once

#include <string>

#include "window_ingress/configuration/common_params.hpp"
#include "window_ingress/navigation/navigator_params.hpp"

namespace window_ingress::configuration {

struct EngagementParams {
  bool required =
      false;  ///< a mission may only start once somebody has said that the vehicle follows setpoints
  double max_silence_sec = 3.0;  ///< who has said so once must go on saying it [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 60.0);
  }
};

struct SetpointWatchParams {
  bool required = false;          ///< a mission may only start once the guard has passed something on
  double max_silence_sec = 0.25;  ///< once it has, it must go on [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("required", self.required);
    field("max_silence_sec", self.max_silence_sec, 0.1, 5.0);
  }
};

struct NavigatorNodeParams {
  double rate_hz = 30.0;  ///< of the setpoints [Hz]
  double max_silence_sec =
      0.25;  ///< odometry that has not arrived for this long, on the steady clock, is gone [s]
  double max_pose_silence_sec = 1.5;  ///< likewise the messages on window_pose [s]
  std::string setpoint_frame =
      "odom";             ///< axes of the setpoints: odom or base_link, whatever these frames are called
  bool lockstep = false;  ///< with the simulated world, step by step; only with use_sim_time
  bool start_at_once =
      false;  ///< in lockstep: the mission starts with the first step at which it may, not when asked
  FrameNames frames;
  StampLimits stamps;
  EngagementParams engagement;
  SetpointWatchParams guard;
  navigation::NavigatorParams navigator;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 20.0, 200.0);
    field("max_silence_sec", self.max_silence_sec, 0.05, 5.0);
    field("max_pose_silence_sec", self.max_pose_silence_sec, 0.05, 5.0);
    field("setpoint_frame", self.setpoint_frame);
    field("lockstep", self.lockstep);
    field("start_at_once", self.start_at_once);
    FrameNames::visit(self.frames, field);
    field.group("stamps", self.stamps);
    field.group("engagement", self.engagement);
    field.group("guard", self.guard);
    field.group("navigator", self.navigator);
  }
};

}  // namespace window_ingress::configuration
