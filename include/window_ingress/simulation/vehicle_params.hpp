/// Parameters of the vehicle and the air around it; see `Scenario`.
#pragma once

#include <Eigen/Core>
#include <string>

namespace window_ingress::simulation {

/// The quadrotor and its velocity controller.
struct VehicleParams {
  std::string profile = "default";           ///< of the autopilot: sets the defaults of vehicle and odometry
  double half_length_m = 0.20;               ///< half of its box along x, propellers included [m]
  double half_width_m = 0.20;                ///< half of its box along y [m]
  double half_height_m = 0.07;               ///< half of its box along z [m]
  double velocity_time_constant_sec = 0.40;  ///< of the answer to a velocity setpoint [s]
  double velocity_integral_per_sec = 0.5;    ///< how fast steady wind is trimmed out [1/s]
  double max_acceleration_mps2 = 3.0;        ///< the most that the velocity controller asks for [m/s^2]
  double max_tilt_rad = 0.40;                ///< the most that the velocity controller tilts it [rad]
  double attitude_time_constant_sec = 0.10;  ///< of the attitude loop [s]
  double max_tilt_rate_radps = 4.0;          ///< limit of roll and pitch rate [rad/s]
  double yaw_time_constant_sec = 0.15;       ///< of the answer to a yaw rate [s]
  double max_yaw_rate_radps = 2.0;           ///< yaw rates beyond are shortened [rad/s]
  double max_speed_mps = 5.0;                ///< setpoints beyond are shortened [m/s]
  double drag_per_sec = 0.25;                ///< deceleration for each m/s through the air [1/s]
  double command_timeout_sec = 0.5;          ///< without a new setpoint for so long, it brakes to hover [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("profile", self.profile, {"default", "external"});
    field("half_length_m", self.half_length_m, 0.02, 1.0);
    field("half_width_m", self.half_width_m, 0.02, 1.0);
    field("half_height_m", self.half_height_m, 0.02, 1.0);
    field("velocity_time_constant_sec", self.velocity_time_constant_sec, 0.25, 3.0);
    field("velocity_integral_per_sec", self.velocity_integral_per_sec, 0.0, 2.0);
    field("max_acceleration_mps2", self.max_acceleration_mps2, 0.2, 8.0);
    field("max_tilt_rad", self.max_tilt_rad, 0.05, 1.0);
    field("attitude_time_constant_sec", self.attitude_time_constant_sec, 0.03, 0.5);
    field("max_tilt_rate_radps", self.max_tilt_rate_radps, 0.5, 20.0);
    field("yaw_time_constant_sec", self.yaw_time_constant_sec, 0.03, 2.0);
    field("max_yaw_rate_radps", self.max_yaw_rate_radps, 0.1, 6.0);
    field("max_speed_mps", self.max_speed_mps, 0.2, 20.0);
    field("drag_per_sec", self.drag_per_sec, 0.0, 2.0);
    field("command_timeout_sec", self.command_timeout_sec, 0.05, 10.0);
  }
  Eigen::Vector3d halfExtents() const { return {half_length_m, half_width_m, half_height_m}; }
};

/// Movement of the air outside and inside, along the window's axes.
struct WindParams {
  double x_mps = 0.0;                   ///< towards the wall [m/s]
  double y_mps = 0.0;                   ///< to the left as seen when looking at the window [m/s]
  double z_mps = 0.0;                   ///< up [m/s]
  double gust_mps = 0.0;                ///< standard deviation of the gusts, each axis [m/s]
  double gust_time_constant_sec = 1.0;  ///< how long a gust lasts [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("x_mps", self.x_mps, -15.0, 15.0);
    field("y_mps", self.y_mps, -15.0, 15.0);
    field("z_mps", self.z_mps, -5.0, 5.0);
    field("gust_mps", self.gust_mps, 0.0, 10.0);
    field("gust_time_constant_sec", self.gust_time_constant_sec, 0.05, 60.0);
  }
};

}  // namespace window_ingress::simulation
