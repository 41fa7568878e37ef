/// Parameters of the vehicle and of the air around it; see `Scenario`.
#pragma once

#include <Eigen/Core>
#include <string>

namespace window_ingress::simulation {

/// The quadrotor and its autopilot. It must tilt to accelerate.
struct QuadrotorParams {
  std::string profile = "default";   ///< of the autopilot: sets the defaults of vehicle and odometry
  double half_length_m = 0.20;       ///< half of its box along x, propellers included [m]
  double half_width_m = 0.20;        ///< half of its box along y [m]
  double half_height_m = 0.07;       ///< half of its box along z [m]
  double mass_kg = 1.5;              ///< for which its controllers are tuned [kg]
  double payload_kg = 0.0;           ///< carried beside it, unknown to its controllers [kg]
  double thrust_gain_error = 0.0;    ///< thrust that it gives beyond the thrust wanted, as a part of it
  double attitude_gain_error = 0.0;  ///< gain of the attitude loop beyond the gain tuned, as a part of it
  double velocity_gain = 1.0;        ///< velocity reached for each m/s asked
  double yaw_rate_gain = 1.0;        ///< yaw rate reached for each rad/s asked
  double setpoint_acceleration_mps2 =
      0.0;  ///< the velocity setpoint is changed at most so fast [m/s^2]; 0: at once
  double setpoint_time_constant_sec =
      0.0;                          ///< how smoothly the setpoint ends its change [s]; 0: straight ramp
  double setpoint_jerk_mps3 = 0.0;  ///< limit of the change of the setpoint's acceleration [m/s^3]; 0: none
  double acceleration_feed_forward = 0.0;  ///< part of the setpoint's acceleration that is fed forward
  double position_hold_per_sec = 0.0;  ///< pull to where the setpoint would have brought it [1/s]; 0: none
  double velocity_time_constant_sec = 0.40;  ///< of the answer to a velocity setpoint [s]
  double velocity_integral_per_sec = 0.5;    ///< how fast steady wind is trimmed out [1/s]
  double max_acceleration_mps2 = 3.0;        ///< the most that the velocity controller asks for [m/s^2]
  double max_tilt_rad = 0.40;                ///< the most that the velocity controller tilts it [rad]
  double attitude_time_constant_sec = 0.10;  ///< of the attitude loop [s]
  double max_tilt_rate_radps = 4.0;          ///< limit of roll and pitch rate [rad/s]
  double yaw_time_constant_sec = 0.15;       ///< of the answer to a yaw rate [s]
  double max_yaw_rate_radps = 2.0;           ///< yaw rates beyond are shortened [rad/s]
  double max_speed_mps = 5.0;                ///< setpoints beyond are shortened [m/s]
  double drag_per_sec = 0.25;        ///< deceleration for each m/s through the air, without payload [1/s]
  double command_timeout_sec = 0.5;  ///< without a new setpoint for so long, it brakes to hover [s]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field.choice("profile", self.profile,
                 {"default", "arducopter_4_0", "arducopter_4_0_default", "arducopter_4_3", "crisp",
                  "px4_1_13_gps", "slow", "external"});
    field("half_length_m", self.half_length_m, 0.02, 1.0);
    field("half_width_m", self.half_width_m, 0.02, 1.0);
    field("half_height_m", self.half_height_m, 0.02, 1.0);
    field("mass_kg", self.mass_kg, 0.05, 50.0);
    field("payload_kg", self.payload_kg, 0.0, 20.0);
    field("thrust_gain_error", self.thrust_gain_error, -0.4, 0.4);
    field("attitude_gain_error", self.attitude_gain_error, -0.5, 0.5);
    field("velocity_gain", self.velocity_gain, 0.5, 1.5);
    field("yaw_rate_gain", self.yaw_rate_gain, 0.5, 1.5);
    field("setpoint_acceleration_mps2", self.setpoint_acceleration_mps2, 0.0, 20.0);
    field("setpoint_time_constant_sec", self.setpoint_time_constant_sec, 0.0, 3.0);
    field("setpoint_jerk_mps3", self.setpoint_jerk_mps3, 0.0, 100.0);
    field("acceleration_feed_forward", self.acceleration_feed_forward, 0.0, 1.0);
    field("position_hold_per_sec", self.position_hold_per_sec, 0.0, 3.0);
    field("velocity_time_constant_sec", self.velocity_time_constant_sec, 0.05, 3.0);
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
  /// Of the mass carried to the mass known.
  double massRatio() const { return 1.0 + payload_kg / mass_kg; }
  Eigen::Vector3d halfExtents() const { return {half_length_m, half_width_m, half_height_m}; }
};

/// Movement of the air, along the window's axes, and what the wall does to it.
struct WindParams {
  double x_mps = 0.0;           ///< outside, towards the wall [m/s]
  double y_mps = 0.0;           ///< outside, to the left as seen when looking at the window [m/s]
  double z_mps = 0.0;           ///< outside, up [m/s]
  std::string gusts = "none";   ///< turbulence: none, or the Dryden model of MIL-F-8785C at low altitude
  double wind_20ft_mps = 5.0;   ///< wind at 20 feet, from which the strength of Dryden's gusts follows [m/s]
  double inside_part = 0.1;     ///< of outside wind and gusts, what is left of them in the room
  double draught_mps = 0.0;     ///< through the opening, into the room; negative: out of it [m/s]
  double wall_push_mps2 = 0.0;  ///< acceleration towards the wall of a vehicle that touches it [m/s^2]
  double wall_push_length_m = 0.3;  ///< gap to the wall over which that push falls to 37 % [m]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("x_mps", self.x_mps, -15.0, 15.0);
    field("y_mps", self.y_mps, -15.0, 15.0);
    field("z_mps", self.z_mps, -5.0, 5.0);
    field.choice("gusts", self.gusts, {"none", "dryden"});
    field("wind_20ft_mps", self.wind_20ft_mps, 0.0, 25.0);
    field("inside_part", self.inside_part, 0.0, 1.0);
    field("draught_mps", self.draught_mps, -10.0, 10.0);
    field("wall_push_mps2", self.wall_push_mps2, -5.0, 5.0);
    field("wall_push_length_m", self.wall_push_length_m, 0.02, 3.0);
  }
};

}  // namespace window_ingress::simulation
