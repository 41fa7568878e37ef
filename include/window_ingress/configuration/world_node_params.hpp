#pragma once

#include <string>

#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::configuration {

struct WorldNodeParams {
  std::string scenario;  ///< scenario file; empty: calm air, start five metres in front of the window
  int seed = 1;          ///< seed of everything that the scenario marks random
  std::string start_at = "scenario";  ///< position of the house: from the scenario, or, for a vehicle
                                      ///< simulated elsewhere, in front of that vehicle at its first message
                                      ///< and at each ~reset
  bool next_seed_at_reset = false;  ///< each ~reset takes the next seed: another flight of the same scenario
  double real_time_factor = 1.0;    ///< simulated time over real time, if the machine can keep up
  double wait_sec = 0.0;  ///< longest wait for subscribers to images and odometry before time starts [s]
  bool lockstep = false;  ///< wait at each image until the vehicle has answered, so that runs repeat exactly
  bool realtime = false;  ///< in lockstep: run no faster than real_time_factor instead of as fast as possible
  double lockstep_timeout_sec = 2.0;  ///< in lockstep: longest wait for the vehicle's answer, on the steady
                                      ///< clock [s]
  std::string camera_info_url;  ///< calibration file (file:///.. or package://..) that camera_info publishes
                                ///< and set_camera_info writes; empty: the true calibration
  std::string verdict_file;     ///< JSON file for the referee's verdict, written at the end; empty: none
  std::string camera_frame = "camera_optical_frame";  ///< frame_id of the images
  navigation::FrameNames frames;
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
