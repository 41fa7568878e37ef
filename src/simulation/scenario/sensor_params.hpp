/// Parameters of odometry and inertial sensors; see `Scenario`.
#pragma once

#include <string>

namespace window_ingress::simulation {

/// What is wrong with the vehicle's odometry.
struct OdometryParams {
  double rate_hz = 50.0;      ///< samples a second [1/s]
  double latency_sec = 0.03;  ///< from measurement to delivery [s]
  double jitter_sec = 0.0;    ///< further delay of a sample, drawn evenly from 0 to this [s]
  double burst_period_sec =
      0.0;  ///< samples wait and are delivered together at multiples of this [s]; 0: at once
  double stamp_offset_sec =
      0.0;  ///< of the stamp after the true time of measurement; negative: before it [s]
  double estimate_delay_sec = 0.01;  ///< age of the velocity that the vehicle's own velocity loop acts on [s]
  double position_noise_m = 0.004;   ///< white noise, standard deviation of each axis [m]
  double velocity_noise_mps = 0.02;  ///< white noise, each axis [m/s]
  double velocity_bias_mps =
      0.0;  ///< steady horizontal error of the velocity, fixed in the body; where to: drawn
  double velocity_bias_spread_mps =
      0.0;                     ///< its size is drawn evenly within so much of velocity_bias_mps [m/s]
  double own_bias_part = 0.0;  ///< part of that error on which the vehicle's own velocity loop acts, too
  double attitude_noise_rad = 0.004;  ///< white noise, each axis [rad]
  double heading_error_rad = 0.0;  ///< steady error of the heading, which the positions do not share: drawn
                                   ///< up to this, either way [rad]
  double scale_error = 0.0;  ///< of horizontal movement: the part reported beyond the true one
  double wander_m = 0.0;     ///< error that comes and goes, standard deviation of each horizontal axis [m]
  double wander_correlation_sec = 5.0;  ///< how long such an error lasts [s]
  double drift_m_per_sqrt_sec = 0.01;   ///< random walk of the position, each horizontal axis [m/sqrt(s)]
  double height_drift_m_per_sqrt_sec = 0.004;  ///< random walk of the height [m/sqrt(s)]
  double yaw_drift_rad_per_sqrt_sec = 0.0015;  ///< random walk of the heading [rad/sqrt(s)]
  double height_factor_per_m =
      0.0;  ///< horizontal noise and drift grow by this part for each metre above ground [1/m]
  double texture_quality =
      1.0;  ///< of the ground; horizontal noise and drift are divided by it, by 0.05 at least
  std::string twist_frame =
      "body";  ///< axes of the velocity in odometry messages: body, or those of odom (world)
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 5.0, 400.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("jitter_sec", self.jitter_sec, 0.0, 1.0);
    field("burst_period_sec", self.burst_period_sec, 0.0, 1.0);
    field("stamp_offset_sec", self.stamp_offset_sec, -1.0, 1.0);
    field("estimate_delay_sec", self.estimate_delay_sec, 0.0, 0.3);
    field("position_noise_m", self.position_noise_m, 0.0, 1.0);
    field("velocity_noise_mps", self.velocity_noise_mps, 0.0, 1.0);
    field("velocity_bias_mps", self.velocity_bias_mps, 0.0, 1.0);
    field("velocity_bias_spread_mps", self.velocity_bias_spread_mps, 0.0, 1.0);
    field("own_bias_part", self.own_bias_part, 0.0, 1.0);
    field("attitude_noise_rad", self.attitude_noise_rad, 0.0, 0.3);
    field("heading_error_rad", self.heading_error_rad, 0.0, 0.5);
    field("scale_error", self.scale_error, -0.5, 0.5);
    field("wander_m", self.wander_m, 0.0, 2.0);
    field("wander_correlation_sec", self.wander_correlation_sec, 0.1, 300.0);
    field("drift_m_per_sqrt_sec", self.drift_m_per_sqrt_sec, 0.0, 1.0);
    field("height_drift_m_per_sqrt_sec", self.height_drift_m_per_sqrt_sec, 0.0, 1.0);
    field("yaw_drift_rad_per_sqrt_sec", self.yaw_drift_rad_per_sqrt_sec, 0.0, 0.2);
    field("height_factor_per_m", self.height_factor_per_m, 0.0, 5.0);
    field("texture_quality", self.texture_quality, 0.0, 1.0);
    field.choice("twist_frame", self.twist_frame, {"body", "world"});
  }
};

/// What is wrong with the attitude estimator and the inertial sensors.
struct ImuParams {
  double rate_hz = 100.0;    ///< samples a second [1/s]
  double latency_sec = 0.0;  ///< from measurement to delivery [s]
  double stamp_offset_sec =
      0.0;                      ///< of the stamp after the true time of measurement; negative: before it [s]
  double roll_bias_rad = 0.0;   ///< constant error of roll [rad]
  double pitch_bias_rad = 0.0;  ///< constant error of pitch [rad]
  double attitude_noise_rad = 0.006;      ///< error of roll and of pitch, standard deviation [rad]
  double attitude_correlation_sec = 0.5;  ///< how long such an error lasts [s]; 0: white
  double gyro_bias_radps =
      0.0;  ///< constant error drawn from the seed, standard deviation of each axis [rad/s]
  double gyro_noise_radps = 0.004;         ///< white noise, each axis [rad/s]
  double accelerometer_noise_mps2 = 0.08;  ///< white noise, each axis [m/s^2]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 5.0, 400.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("stamp_offset_sec", self.stamp_offset_sec, -1.0, 1.0);
    field("roll_bias_rad", self.roll_bias_rad, -0.3, 0.3);
    field("pitch_bias_rad", self.pitch_bias_rad, -0.3, 0.3);
    field("attitude_noise_rad", self.attitude_noise_rad, 0.0, 0.3);
    field("attitude_correlation_sec", self.attitude_correlation_sec, 0.0, 60.0);
    field("gyro_bias_radps", self.gyro_bias_radps, 0.0, 0.5);
    field("gyro_noise_radps", self.gyro_noise_radps, 0.0, 1.0);
    field("accelerometer_noise_mps2", self.accelerometer_noise_mps2, 0.0, 10.0);
  }
};

}  // namespace window_ingress::simulation
