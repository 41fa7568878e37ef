/// Parameters of odometry and inertial sensors; see `Scenario`.
#pragma once

namespace window_ingress::simulation {

/// What is wrong with the vehicle's odometry.
struct OdometryParams {
  double rate_hz = 50.0;               ///< samples a second [1/s]
  double latency_sec = 0.03;           ///< from measurement to delivery [s]
  double position_noise_m = 0.004;     ///< white noise, standard deviation of each axis [m]
  double velocity_noise_mps = 0.02;    ///< white noise, each axis [m/s]
  double attitude_noise_rad = 0.004;   ///< white noise, each axis [rad]
  double drift_m_per_sqrt_sec = 0.01;  ///< random walk of the position, each horizontal axis [m/sqrt(s)]
  double height_drift_m_per_sqrt_sec = 0.004;  ///< random walk of the height [m/sqrt(s)]
  double yaw_drift_rad_per_sqrt_sec = 0.0015;  ///< random walk of the heading [rad/sqrt(s)]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 5.0, 400.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("position_noise_m", self.position_noise_m, 0.0, 1.0);
    field("velocity_noise_mps", self.velocity_noise_mps, 0.0, 1.0);
    field("attitude_noise_rad", self.attitude_noise_rad, 0.0, 0.3);
    field("drift_m_per_sqrt_sec", self.drift_m_per_sqrt_sec, 0.0, 1.0);
    field("height_drift_m_per_sqrt_sec", self.height_drift_m_per_sqrt_sec, 0.0, 1.0);
    field("yaw_drift_rad_per_sqrt_sec", self.yaw_drift_rad_per_sqrt_sec, 0.0, 0.2);
  }
};

/// What is wrong with the attitude estimator and the inertial sensors.
struct ImuParams {
  double rate_hz = 100.0;                  ///< samples a second [1/s]
  double attitude_noise_rad = 0.006;       ///< error of roll and of pitch, standard deviation [rad]
  double attitude_correlation_sec = 0.5;   ///< how long such an error lasts [s]; 0: white
  double gyro_noise_radps = 0.004;         ///< white noise, each axis [rad/s]
  double accelerometer_noise_mps2 = 0.08;  ///< white noise, each axis [m/s^2]
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("rate_hz", self.rate_hz, 5.0, 400.0);
    field("attitude_noise_rad", self.attitude_noise_rad, 0.0, 0.3);
    field("attitude_correlation_sec", self.attitude_correlation_sec, 0.0, 60.0);
    field("gyro_noise_radps", self.gyro_noise_radps, 0.0, 1.0);
    field("accelerometer_noise_mps2", self.accelerometer_noise_mps2, 0.0, 10.0);
  }
};

}  // namespace window_ingress::simulation
