/// The content of a world. Every key of a scenario file is a field in one of the `visit` functions here;
/// doc/scenarios.md explains all keys.
#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "simulation/scenario/house_params.hpp"
#include "simulation/scenario/quadrotor_params.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/scenario/wind_params.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::simulation {

/// Where the flight starts, relative to the target window.
struct StartParams {
  double distance_m = 5.0;    ///< horizontal distance from the opening's centre [m]
  double off_axis_rad = 0.0;  ///< bearing from the window's outward normal; positive: left of it for
                              ///< somebody who looks at the window [rad]
  double heading_rad = 0.0;  ///< heading relative to the direction to the window; positive: turned left [rad]
  double height_offset_m = 0.0;  ///< height above the opening's centre; ignored on the ground [m]
  double odom_x_m = 0.0;         ///< x of the start in the odometry frame [m]
  double odom_y_m = 0.0;         ///< y of the start in the odometry frame [m]
  double odom_yaw_rad = 0.0;     ///< heading of the start in the odometry frame [rad]
  bool hovering = true;          ///< true: starts hovering; false: starts on the ground
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

/// One world. The default `Scenario` is a calm day: 5 m straight in front of the window, facing it.
struct Scenario {
  double time_limit_sec = 60.0;  ///< time limit of the flight [s]
  std::string glass = "as_set";  ///< `commit/glass` of the navigator in `fly`; as_set: not changed
  std::string unverified_opening = "as_set";  ///< `commit/unverified_opening` in `fly`; as_set: not changed
  bool target_chosen = false;  ///< the operator selects the target once it is seen, and then starts
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
  /// Above the ground [m].
  double windowCentreHeight() const { return window.sill_m + 0.5 * window.height_m; }
  Eigen::Isometry3d startPoseInWindow() const;  ///< T_window_base
  Eigen::Isometry3d startPoseInOdom() const;    ///< T_odom_base; z = 0 is the ground
  Eigen::Isometry3d T_odom_window() const;      ///< for a house at its resting place
  /// Moves start and house so that the start lies at the vehicle's place, except for its height.
  void startAt(const Eigen::Isometry3d& T_odom_base);
};

/// Makes vehicle and odometry respond as with a real autopilot: sets the known values of the profile and
/// leaves the others.
///
/// `arducopter_4_0`, `arducopter_4_3`: ArduCopter 4.0.7 and 4.3.2 in software-in-the-loop behind MAVROS.
/// `arducopter_4_0_default`: ArduCopter 4.0.7 with its default acceleration and its gyro's drift.
/// `px4_1_13_gps`: PX4 1.13 with GPS. `crisp`: a simulator's controller (so3) that responds in a fifth of a
/// second. `slow`: the default vehicle with at most 0.6 m/s^2. `default`, `external` and unknown profiles
/// change only the name. Comparison with measurements: test `vehicle_profiles_test.cpp` and doc/scenarios.md.
void applyProfile(const std::string& profile, QuadrotorParams& vehicle, OdometryParams& odometry);

/// All faults of the scenario, one text each: values out of range, inconsistent parts.
std::vector<std::string> faultsOf(const Scenario& scenario);

/// Position of a key's value within its range, 0 to 1, by the key's path ("window/width_m",
/// "faults[0]/at_sec"); of `{one_of: [...]}`, which value. Other keys are drawn from the seed.
using Quantiles = std::map<std::string, double>;

/// Reads a scenario. Any number may be a fixed value or a range `[min, max]`. Each key is drawn from the seed
/// independently, so that another range leaves the other values unchanged. \throws InputError with file, line
/// and key
Scenario loadScenario(const std::string& file, std::uint32_t seed, const Quantiles& quantiles = {});

}  // namespace window_ingress::simulation
