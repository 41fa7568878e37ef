#pragma once

#include <string>

#include "window_ingress/configuration/common_params.hpp"
#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::configuration {

struct PoseNodeParams {
  bool image_is_rectified = false;      ///< the detector works on rectified images: use P of camera_info
  std::string gravity_source = "imu";   ///< where "up" comes from: imu, odom or tf
  double odom_wait_sec = 0.05;          ///< an image waits this long for odometry as new as itself [s]
  bool lockstep = false;                ///< with the simulated world, step by step; only with use_sim_time
  bool publish_tf = false;              ///< broadcast the filtered window as a frame
  std::string window_frame = "window";  ///< its name
  FrameNames frames;
  StampLimits stamps;
  estimation::PoseParams pose;
  estimation::FilterParams filter;
  estimation::TargetEstimatorParams tracker;
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

/// The same for this vehicle: it is what must fit, and what the opening must be open for.
estimation::TargetEstimatorParams forVehicle(estimation::TargetEstimatorParams params,
                                             const navigation::VehicleParams& vehicle);

}  // namespace window_ingress::configuration
