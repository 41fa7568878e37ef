#pragma once

#include <string>

#include "window_ingress/configuration/common_params.hpp"

namespace window_ingress::configuration {

struct WorldNodeParams {
  std::string scenario;               ///< file; empty: a calm day, five metres in front of the window
  int seed = 1;                       ///< of everything that the scenario marks random
  std::string start_at = "scenario";  ///< where the start lies in the odometry frame: as the scenario says,
                                      ///< or, for a vehicle simulated elsewhere, where that is when it is
                                      ///< first heard of and at each ~reset: the house is put before it
  bool next_seed_at_reset = false;  ///< each ~reset takes the next seed: another flight of the same scenario
  double real_time_factor = 1.0;    ///< simulated over real time, if the machine can keep up
  double start_time_sec = 100.0;    ///< simulated time at the start: a stamp of zero means unstamped [s]
  double clock_rate_hz = 100.0;     ///< of /clock, in simulated time [Hz]
  double wait_sec =
      0.0;  ///< time starts when images and odometry are subscribed to, at the latest after this [s]
  bool lockstep =
      false;  ///< the world waits at each image until the vehicle has answered: runs repeat exactly
  bool realtime = false;  ///< in lockstep: not faster than real_time_factor, instead of as fast as it goes
  double lockstep_timeout_sec =
      2.0;                      ///< in lockstep, on the steady clock: longer than this it does not wait [s]
  std::string camera_info_url;  ///< calibration that camera_info tells, and where set_camera_info saves one:
                                ///< file:///.. or package://..; empty: the true one is told
  std::string verdict_file;     ///< json with the referee's verdict, written at the end; empty: none
  std::string camera_frame = "camera_optical_frame";
  FrameNames frames;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("scenario", self.scenario);
    field("seed", self.seed, 0, 2147483647);
    field.choice("start_at", self.start_at, {"scenario", "vehicle"});
    field("next_seed_at_reset", self.next_seed_at_reset);
    field("real_time_factor", self.real_time_factor, 0.01, 100.0);
    field("start_time_sec", self.start_time_sec, 1.0, 1e9);
    field("clock_rate_hz", self.clock_rate_hz, 20.0, 400.0);
    field("wait_sec", self.wait_sec, 0.0, 600.0);
    field("lockstep", self.lockstep);
    field("realtime", self.realtime);
    field("lockstep_timeout_sec", self.lockstep_timeout_sec, 0.05, 600.0);
    field("camera_info_url", self.camera_info_url);
    field("verdict_file", self.verdict_file);
    field("camera_frame", self.camera_frame);
    FrameNames::visit(self.frames, field);
  }
};

}  // namespace window_ingress::configuration
