/// What the vehicle is (config/vehicle.yaml), and what it may be told (`navigator/limits` in
/// config/navigator.yaml).
#pragma once

#include <Eigen/Core>
#include <optional>

namespace window_ingress::navigation {

/// The vehicle's body, camera and manners. Said once, for all who need it.
struct VehicleParams {
  double half_length_m = 0.25;       ///< of the body's box, propellers included, forward [m]
  double half_width_m = 0.25;        ///< likewise, sideways [m]
  double half_height_m = 0.12;       ///< likewise, upward [m]
  double camera_forward_m = 0.1;     ///< camera ahead of the body's centre; where tf says it, tf counts [m]
  double horizontal_fov_rad = 1.39;  ///< of the camera; where camera_info says it, that counts [rad]
  double vertical_fov_rad = 1.12;    ///< of the camera; where camera_info says it, that counts [rad]
  double pixel_rad = 0.0018;  ///< angle that a pixel in the image's middle covers, 1 / focal length; where
                              ///< camera_info says it, that counts [rad]
  double exposure_sec = 0.004;  ///< of an image, at the darkest [s]
  double response_sec = 0.3;    ///< from a setpoint to the velocity following it, latency included [s]
  double braking_mps2 = 1.2;    ///< deceleration that can be relied upon [m/s^2]
  std::optional<double> climb_response_sec;  ///< up and down; no parameter, measured in flight

  /// The time to answer of each axis: forward, sideways, up.
  Eigen::Vector3d responsesSec() const {
    return {response_sec, response_sec, climb_response_sec.value_or(response_sec)};
  }

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("half_length_m", self.half_length_m, 0.02, 2.0);
    field("half_width_m", self.half_width_m, 0.02, 2.0);
    field("half_height_m", self.half_height_m, 0.02, 2.0);
    field("camera_forward_m", self.camera_forward_m, -1.0, 1.0);
    field("horizontal_fov_rad", self.horizontal_fov_rad, 0.3, 2.8);
    field("vertical_fov_rad", self.vertical_fov_rad, 0.3, 2.8);
    field("pixel_rad", self.pixel_rad, 1e-4, 0.1);
    field("exposure_sec", self.exposure_sec, 0.0, 0.5);
    field("response_sec", self.response_sec, 0.0, 2.0);
    field("braking_mps2", self.braking_mps2, 0.2, 10.0);
  }
};

/// What a setpoint may be, whatever was wished.
struct LimitParams {
  double speed_mps = 1.0;                ///< magnitude of the velocity [m/s]
  double acceleration_mps2 = 2.0;        ///< magnitude of its change [m/s^2]
  double jerk_mps3 = 30.0;               ///< magnitude of the acceleration's change [m/s^3]
  double yaw_rate_radps = 0.5;           ///< [rad/s]
  double yaw_acceleration_radps2 = 2.0;  ///< [rad/s^2]
  double min_height_m = 0.3;             ///< of odom: no way down below this [m]
  double max_height_m = 10.0;            ///< of odom: no way up above this [m]
  double fence_radius_m = 25.0;          ///< around the place of the start: no way out of this [m]
  double wall_distance_m = 0.9;          ///< outside the funnel, nearer to the window's plane: only away [m]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("speed_mps", self.speed_mps, 0.05, 5.0);
    field("acceleration_mps2", self.acceleration_mps2, 0.1, 10.0);
    field("jerk_mps3", self.jerk_mps3, 0.5, 1000.0);
    field("yaw_rate_radps", self.yaw_rate_radps, 0.05, 3.0);
    field("yaw_acceleration_radps2", self.yaw_acceleration_radps2, 0.1, 20.0);
    field("min_height_m", self.min_height_m, -1000.0, 1000.0);
    field("max_height_m", self.max_height_m, -1000.0, 1000.0);
    field("fence_radius_m", self.fence_radius_m, 1.0, 10000.0);
    field("wall_distance_m", self.wall_distance_m, 0.0, 20.0);
  }
};

}  // namespace window_ingress::navigation
