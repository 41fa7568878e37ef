/// The one form in which a user changes parameters: a yaml file whose first level names the nodes, and the
/// vehicle.
#pragma once

#include <set>
#include <string>

#include "window_ingress/configuration/detector_node_params.hpp"
#include "window_ingress/configuration/guard_params.hpp"
#include "window_ingress/configuration/navigator_node_params.hpp"
#include "window_ingress/configuration/pose_node_params.hpp"
#include "window_ingress/configuration/world_node_params.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::configuration {

/// All that may stand in such a file, at its defaults. Launch files take it as config:=, tools as --params;
/// each takes what concerns it from there and lets the rest be.
struct Overlay {
  navigation::VehicleParams vehicle;
  DetectorNodeParams window_detector;
  PoseNodeParams homography_pose;
  NavigatorNodeParams ingress_navigator;
  GuardParams setpoint_guard;
  WorldNodeParams world;

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.group("vehicle", self.vehicle);
    field.group("window_detector", self.window_detector);
    field.group("homography_pose", self.homography_pose);
    field.group("ingress_navigator", self.ingress_navigator);
    field.group("setpoint_guard", self.setpoint_guard);
    field.group("world", self.world);
  }

  std::set<std::string> said;  ///< paths of what the last file says: "vehicle/half_width_m"
};

/// Reads a file over what there is; no file, an empty name, leaves everything as it is. What it says of the
/// vehicle is told to pose node and navigator, too. \throws InputError that names file, line and key of what
/// nobody reads and of what cannot be
Overlay readOverlay(const std::string& file, Overlay overlay = {});

}  // namespace window_ingress::configuration
