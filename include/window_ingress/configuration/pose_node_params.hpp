#pragma once

#include <string>

#include "window_ingress/configuration/common_params.hpp"
#include "window_ingress/navigation/target_tracker.hpp"
#include "window_ingress/pose/filter_params.hpp"
#include "window_ingress/pose/pose_params.hpp"

namespace window_ingress::configuration {

struct PoseNodeParams {
  bool image_is_rectified = false;      ///< the detector works on rectified pictures: use P of camera_info
  std::string gravity_source = "imu";   ///< where "up" comes from: imu, odom or tf
  double odom_wait_sec = 0.05;          ///< an image waits this long for odometry as new as itself [s]
  bool lockstep = false;                ///< with the simulated world, step by step; only with use_sim_time
  bool publish_tf = false;              ///< broadcast the filtered window as a frame
  std::string window_frame = "window";  ///< its name
  FrameNames frames;
  StampLimits stamps;
  pose::PoseParams pose;
  pose::FilterParams filter;
  navigation::TrackerParams tracker;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("image_is_rectified", self.image_is_rectified);
    field("gravity_source", self.gravity_source);
    field("odom_wait_sec", self.odom_wait_sec, 0.0, 0.5);
    field("lockstep", self.lockstep);
    field("publish_tf", self.publish_tf);
    field("window_frame", self.window_frame);
    FrameNames::visit(self.frames, field);
    field.group("stamps", self.stamps);
    field.group("pose", self.pose);
    field.group("filter", self.filter);
    field.group("tracker", self.tracker);
  }
};

}  // namespace window_ingress::configuration
