/// The one format in which a user changes parameters: a yaml file with a section for each node and for the
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

/// All parameters that such a file may set, at their defaults. Launch files take the file as config:=, tools
/// as --params; each uses the sections that concern it.
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

  std::set<std::string> given;  ///< paths of the keys in the last file: "vehicle/half_width_m"
  bool gives(const std::string& key) const { return given.count(key) > 0; }
};

/// Replaces the values that a file gives; an empty name changes nothing. The pose node and the navigator get
/// the vehicle's values, too.
/// \throws InputError that names file, line and key of each unknown key and each invalid value
Overlay readOverlay(const std::string& file, Overlay overlay = {});

}  // namespace window_ingress::configuration
