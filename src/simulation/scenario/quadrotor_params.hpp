/// Parameters of the vehicle; see `Scenario`.
#pragma once

#include <Eigen/Core>
#include <string>

namespace window_ingress::simulation {

/// The quadrotor and its autopilot. It must tilt to accelerate.
struct QuadrotorParams {
  std::string profile = "default";   ///< autopilot whose values become the defaults of vehicle and odometry
  double half_length_m = 0.20;       ///< half of the vehicle's box along x, including the propellers [m]
  double half_width_m = 0.20;        ///< half of the vehicle's box along y [m]
  double half_height_m = 0.07;       ///< half of the vehicle's box along z [m]
  double mass_kg = 1.5;              ///< mass for which the controllers are tuned [kg]
  double payload_kg = 0.0;           ///< additional mass, unknown to the controllers [kg]
  double thrust_gain_error = 0.0;    ///< relative error of the thrust: 0.1 gives 10 % more than wanted
  double attitude_gain_error = 0.0;  ///< relative error of the attitude loop's gain
  double velocity_gain = 1.0;        ///< reached velocity per commanded velocity
  double yaw_rate_gain = 1.0;        ///< reached yaw rate per commanded yaw rate
  double setpoint_acceleration_mps2 = 0.0;  ///< limit on the setpoint's rate of change; 0: none [m/s^2]
  double setpoint_time_constant_sec = 0.0;  ///< time constant at the end of a change; 0: straight ramp [s]
  double setpoint_jerk_mps3 = 0.0;  ///< limit on the change of the setpoint's acceleration; 0: none [m/s^3]
  double acceleration_feed_forward = 0.0;    ///< share of the setpoint's acceleration that is fed forward
  double position_hold_per_sec = 0.0;        ///< pull to where the setpoints would have led; 0: none [1/s]
  double velocity_time_constant_sec = 0.40;  ///< time constant of the answer to a velocity setpoint [s]
  double velocity_integral_per_sec = 0.5;    ///< rate at which the controller compensates steady wind [1/s]
  double max_acceleration_mps2 = 3.0;        ///< largest acceleration from the velocity controller [m/s^2]
  double max_tilt_rad = 0.40;                ///< largest tilt from the velocity controller [rad]
  double attitude_time_constant_sec = 0.10;  ///< time constant of the attitude loop [s]
  double max_tilt_rate_radps = 4.0;          ///< limit of roll and pitch rate [rad/s]
  double yaw_time_constant_sec = 0.15;       ///< time constant of the answer to a yaw rate [s]
  double max_yaw_rate_radps = 2.0;           ///< larger yaw rates are limited to this [rad/s]
  double max_speed_mps = 5.0;                ///< faster setpoints are limited to this [m/s]
  double drag_per_sec = 0.25;                ///< deceleration per m/s of airspeed, without payload [1/s]
  double command_timeout_sec = 0.5;  ///< without setpoints for this long, the vehicle brakes to hover [s]
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
  /// Carried mass over known mass.
  double massRatio() const { return 1.0 + payload_kg / mass_kg; }
  Eigen::Vector3d halfExtents() const { return {half_length_m, half_width_m, half_height_m}; }
};

}  // namespace window_ingress::simulation
