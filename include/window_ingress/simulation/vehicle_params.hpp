/// Parameters of the vehicle, its sensors and the air around it; see `Scenario`.
#pragma once

#include <Eigen/Geometry>

#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::simulation {

/// The camera and how it is mounted.
struct CameraParams {
  int width_px = 640;                                       ///< of the picture [px]
  int height_px = 480;                                      ///< of the picture [px]
  double horizontal_fov_rad = 1.20;                         ///< of the lens without its distortion [rad]
  double k1 = 0.0, k2 = 0.0, p1 = 0.0, p2 = 0.0, k3 = 0.0;  ///< distortion of the model plumb_bob
  double x_m = 0.10;          ///< of the camera, forward of the vehicle's centre [m]
  double y_m = 0.0;           ///< of the camera, to the left [m]
  double z_m = 0.02;          ///< of the camera, up [m]
  double pitch_rad = 0.0;     ///< of the camera: looking down is positive [rad]
  double yaw_rad = 0.0;       ///< of the camera: looking left is positive [rad]
  double rate_hz = 30.0;      ///< pictures a second [1/s]
  double latency_sec = 0.03;  ///< from exposure to delivery [s]
  double noise_grey = 2.0;    ///< standard deviation of each channel [grey levels]
  double blur_px = 0.6;       ///< standard deviation of the lens's blur [px]
  double gain = 1.0;          ///< exposure: all brightness times this
  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("width_px", self.width_px, 64, 1920);
    field("height_px", self.height_px, 48, 1440);
    field("horizontal_fov_rad", self.horizontal_fov_rad, 0.2, 2.4);
    field("k1", self.k1, -1.0, 1.0);
    field("k2", self.k2, -1.0, 1.0);
    field("p1", self.p1, -0.1, 0.1);
    field("p2", self.p2, -0.1, 0.1);
    field("k3", self.k3, -1.0, 1.0);
    field("x_m", self.x_m, -1.0, 1.0);
    field("y_m", self.y_m, -1.0, 1.0);
    field("z_m", self.z_m, -1.0, 1.0);
    field("pitch_rad", self.pitch_rad, -1.5, 1.5);
    field("yaw_rad", self.yaw_rad, -3.15, 3.15);
    field("rate_hz", self.rate_hz, 1.0, 120.0);
    field("latency_sec", self.latency_sec, 0.0, 1.0);
    field("noise_grey", self.noise_grey, 0.0, 40.0);
    field("blur_px", self.blur_px, 0.0, 5.0);
    field("gain", self.gain, 0.1, 4.0);
  }
  geometry::PinholeCamera model() const;
  Eigen::Isometry3d T_base_camera() const;
};

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

/// The quadrotor and its velocity controller.
struct VehicleParams {
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
