#pragma once

#include <string>

#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::configuration {

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

}  // namespace window_ingress::configuration
