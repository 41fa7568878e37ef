#pragma once

#include <string>

#include "window_ingress/estimation/filter_params.hpp"
#include "window_ingress/estimation/pose_params.hpp"
#include "window_ingress/estimation/target_estimator.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::configuration {

struct PoseNodeParams {
  std::string gravity_source = "imu";   ///< source of the direction of gravity
  double odom_wait_sec = 0.05;          ///< longest time an image waits for odometry up to its own stamp [s]
  bool lockstep = false;                ///< run step by step with the simulated world; only with use_sim_time
  bool publish_tf = false;              ///< broadcast the filtered window as a tf frame
  std::string window_frame = "window";  ///< name of the tf frame of the filtered window
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

/// `params` with the vehicle's values, and with those that pose and filter share, filled in.
PoseNodeParams forVehicle(PoseNodeParams params, const navigation::VehicleParams& vehicle);

/// Size of opening that the vehicle needs, margins included.
geometry::OpeningSize neededBy(const navigation::VehicleParams& vehicle);

}  // namespace window_ingress::configuration
