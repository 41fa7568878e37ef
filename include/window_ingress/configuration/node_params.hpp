/// Parameters of the nodes.
#pragma once

#include <string>
#include <vector>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/navigator_params.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"

namespace window_ingress::configuration {

using navigation::FrameNames;
using navigation::StampLimits;

/// Which images are taken.
struct ImageLimits {
  int max_pixels = 8000000;  ///< images of more pixels are refused [px]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("max_pixels", self.max_pixels, 1, 100000000);
  }
};

/// The reference image.
struct ReferenceParams {
  std::string picture;          ///< JPEG or PNG file of the target; empty: no reference
  std::vector<double> corners;  ///< corners of the opening's inner border in the reference image, x1 y1 .. x4
                                ///< y4 from top left, clockwise [px]; empty: the whole image is the target
                                ///< with its frame
  std::string capture_file;     ///< JPEG or PNG file that ~capture_reference writes; beside it .yaml, these
                             ///< parameters for it, and _understood.png, what is made of it; empty: nothing
                             ///< is written
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("picture", self.picture);
    field("corners", self.corners);
    field("capture_file", self.capture_file);
  }
};

struct DetectorNodeParams {
  std::string image_transport = "raw";  ///< raw, compressed, or a plugin of image_transport
  bool use_imu = true;     ///< predict tracks by the vehicle's attitude from `imu`, where messages come
  double budget_ms = 0.0;  ///< diagnostics warn if an image takes longer; 0: the time between two images [ms]
  bool lockstep = false;   ///< run step by step with the simulated world; only with use_sim_time
  ImageLimits image;
  ReferenceParams reference;
  detection::DetectorParams detector;
  openness::InteriorKltParams interior;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("image_transport", self.image_transport);
    field("use_imu", self.use_imu);
    field("budget_ms", self.budget_ms, 0.0, 10000.0);
    field("lockstep", self.lockstep);
    field.group("image", self.image);
    field.group("reference", self.reference);
    field.group("detector", self.detector);
    field.group("interior", self.interior);
  }
};

struct PoseNodeParams {
  std::string gravity_source = "imu";   ///< where "up" comes from
  double odom_wait_sec = 0.05;          ///< longest wait of an image for odometry as new as itself [s]
  bool lockstep = false;                ///< run step by step with the simulated world; only with use_sim_time
  bool publish_tf = false;              ///< broadcast the filtered window as a frame
  std::string window_frame = "window";  ///< name of the frame that is broadcast for the filtered window
  estimation::PoseParams pose;
  estimation::FilterParams filter;
  estimation::TargetEstimatorParams tracker;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("gravity_source", self.gravity_source, {"imu", "odom", "tf"});
    field("odom_wait_sec", self.odom_wait_sec, 0.0, 0.5);
    field("lockstep", self.lockstep);
    field("publish_tf", self.publish_tf);
    field("window_frame", self.window_frame);
    field.group("pose", self.pose);
    field.group("filter", self.filter);
    field.group("tracker", self.tracker);
  }
};

/// The same with what is said of the vehicle, and once for pose and filter.
PoseNodeParams forVehicle(PoseNodeParams params, const navigation::VehicleParams& vehicle);

/// Of the opening: the vehicle with its margins.
geometry::OpeningSize neededBy(const navigation::VehicleParams& vehicle);

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

struct GuardParams {
  double rate_hz = 30.0;            ///< rate of the setpoints sent to the autopilot [Hz]
  double late_sec = 0.2;            ///< an input older than this, on the steady clock, no longer counts [s]
  double max_speed_mps = 1.2;       ///< a faster setpoint is a fault: zero is sent [m/s]
  double max_yaw_rate_radps = 1.0;  ///< a setpoint that turns faster is a fault: zero is sent [rad/s]
  double stop_streaming_after_sec = 10.0;  ///< zeros for this long when sane input has stopped coming, then
                                           ///< nothing at all, so that the autopilot's own failsafe acts; 0:
                                           ///< zeros for ever [s]
  bool lockstep = false;       ///< pass each input on at once and send nothing else; for the simulated world
  std::string frame = "odom";  ///< frame_id of the zeros before the first input
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
