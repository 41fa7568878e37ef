/// What a world consists of. Every key of a scenario file is a field listed by one of the `visit` functions
/// here; doc/scenarios.md explains them all.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "simulation/scenario/fault_params.hpp"
#include "simulation/scenario/house_params.hpp"
#include "simulation/scenario/quadrotor_params.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::simulation {

/// Where the flight starts, relative to the target window.
struct StartParams {
  double distance_m = 5.0;    ///< horizontal distance from the opening's centre [m]
  double off_axis_rad = 0.0;  ///< bearing of the start around the window's outward normal; positive: left of
                              ///< it, as seen by somebody who looks at the window [rad]
  double heading_rad = 0.0;   ///< heading beside the direction to the window, positive: turned left [rad]
  double height_offset_m = 0.0;  ///< above the opening's centre [m]; not used on the ground
  double odom_x_m = 0.0;         ///< place of the start in the odometry frame [m]
  double odom_y_m = 0.0;         ///< likewise [m]
  double odom_yaw_rad = 0.0;     ///< heading of the vehicle in the odometry frame [rad]
  bool hovering = true;          ///< starts hovering; false: stands on the ground
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("distance_m", self.distance_m, 0.8, 15.0);
    field("off_axis_rad", self.off_axis_rad, -1.4, 1.4);
    field("heading_rad", self.heading_rad, -3.15, 3.15);
    field("height_offset_m", self.height_offset_m, -3.0, 10.0);
    field("odom_x_m", self.odom_x_m, -1e5, 1e5);
    field("odom_y_m", self.odom_y_m, -1e5, 1e5);
    field("odom_yaw_rad", self.odom_yaw_rad, -3.15, 3.15);
    field("hovering", self.hovering);
  }
};

/// One world. A plain `Scenario` is a calm day: 5 m straight in front of the window, facing it.
struct Scenario {
  double time_limit_sec = 60.0;  ///< of the flight [s]
  std::string glass = "as_set";  ///< `commit/glass` of the navigator in `fly`; as_set: as its parameters say
  std::string unverified_opening =
      "as_set";  ///< `commit/unverified_opening` of the navigator in `fly`; as_set: as its parameters say
  bool target_chosen = false;  ///< somebody points at the target, once seen, and then starts
  StartParams start;
  WindowParams window;
  std::vector<DecoyParams> decoys;
  std::vector<DoorParams> doors;
  std::vector<PosterParams> posters;
  HouseParams house;
  SwayParams sway;
  CameraParams camera;
  OdometryParams odometry;
  ImuParams imu;
  QuadrotorParams vehicle;
  WindParams wind;
  std::vector<FaultParams> faults;
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("time_limit_sec", self.time_limit_sec, 1.0, 3600.0);
    field.choice("glass", self.glass, {"as_set", "excluded", "possible"});
    field.choice("unverified_opening", self.unverified_opening, {"as_set", "allow", "ask", "deny"});
    field("target_chosen", self.target_chosen);
    field.group("start", self.start);
    field.group("window", self.window);
    field.list("decoys", self.decoys);
    field.list("doors", self.doors);
    field.list("posters", self.posters);
    field.group("house", self.house);
    field.group("sway", self.sway);
    field.group("camera", self.camera);
    field.group("odometry", self.odometry);
    field.group("imu", self.imu);
    field.group("vehicle", self.vehicle);
    field.group("wind", self.wind);
    field.list("faults", self.faults);
  }

  geometry::OpeningSize opening() const { return {window.width_m, window.height_m}; }
  double windowCentreHeight() const {
    return window.sill_m + 0.5 * window.height_m;
  }                                             ///< above the ground [m]
  Eigen::Isometry3d startPoseInWindow() const;  ///< T_window_base
  Eigen::Isometry3d startPoseInOdom() const;    ///< T_odom_base; z = 0 is the ground
  Eigen::Isometry3d T_odom_window() const;      ///< of a house at its resting place
  /// The start lies where the vehicle is, whatever its height, and the house accordingly.
  void startAt(const Eigen::Isometry3d& T_odom_base);
};

/// What is wrong with the scenario, one text a fault: values out of range, things that do not fit together.
std::vector<std::string> faultsOf(const Scenario& scenario);

/// Where within its range a key's value lies, 0 to 1, by the key's path ("window/width_m",
/// "faults[0]/at_sec"); of `{one_of: [...]}` which of the values. What is not named is drawn from the seed.
using Quantiles = std::map<std::string, double>;

/// Reads a scenario. Any number may be a fixed value or a range `[min, max]` that is drawn from the seed,
/// each key for itself: a further range leaves the values of the others as they were. \throws InputError
/// with file, line and key
Scenario loadScenario(const std::string& file, std::uint32_t seed, const Quantiles& quantiles = {});

}  // namespace window_ingress::simulation
