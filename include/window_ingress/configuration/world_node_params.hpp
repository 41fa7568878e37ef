#pragma once

#include <string>

#include "window_ingress/configuration/common_params.hpp"

namespace window_ingress::configuration {

struct WorldNodeParams {
  std::string scenario;  ///< scenario file; empty: a calm day, five metres in front of the window
  int seed = 1;          ///< seed of everything that the scenario marks random
  std::string start_at = "scenario";  ///< where the house stands: as the scenario says, or, for a vehicle
                                      ///< simulated elsewhere, before the place where that is first heard of
                                      ///< and at each ~reset
  bool next_seed_at_reset = false;  ///< each ~reset takes the next seed: another flight of the same scenario
  double real_time_factor = 1.0;    ///< simulated over real time, if the machine can keep up
  double wait_sec = 0.0;  ///< longest wait for subscribers to images and odometry before time starts [s]
  bool lockstep = false;  ///< wait at each image until the vehicle has answered: runs repeat exactly
  bool realtime = false;  ///< in lockstep: no faster than real_time_factor, instead of as fast as possible
  double lockstep_timeout_sec = 2.0;  ///< in lockstep: longest wait for the vehicle's answer, on the steady
                                      ///< clock [s]
  std::string camera_info_url;  ///< calibration file that camera_info tells, and where set_camera_info saves
                                ///< one: file:///.. or package://..; empty: the true calibration
  std::string verdict_file;     ///< json file for the referee's verdict, written at the end; empty: none
  std::string camera_frame = "camera_optical_frame";  ///< frame_id of the images
  FrameNames frames;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("scenario", self.scenario);
    field("seed", self.seed, 0, 2147483647);
    field.choice("start_at", self.start_at, {"scenario", "vehicle"});
    field("next_seed_at_reset", self.next_seed_at_reset);
    field("real_time_factor", self.real_time_factor, 0.01, 100.0);
    field("wait_sec", self.wait_sec, 0.0, 600.0);
    field("lockstep", self.lockstep);
    field("realtime", self.realtime);
    field("lockstep_timeout_sec", self.lockstep_timeout_sec, 0.05, 600.0);
    field("camera_info_url", self.camera_info_url);
    field("verdict_file", self.verdict_file);
    field("camera_frame", self.camera_frame);
    navigation::FrameNames::visit(self.frames, field);
  }
};

}  // namespace window_ingress::configuration
