#include "simulation/scenario/scenario.hpp"

namespace window_ingress::simulation {
namespace {

// With a satellite receiver and a compass, errors vary slowly but do not grow.
void setBoundedOdometry(double wander_m, OdometryParams& odometry) {
  odometry.rate_hz = 50.0;
  odometry.wander_m = wander_m;
  odometry.drift_m_per_sqrt_sec = 0.0;
  odometry.height_drift_m_per_sqrt_sec = 0.002;
  odometry.yaw_drift_rad_per_sqrt_sec = 0.0005;
  odometry.twist_frame = "body";
}

// A ramp to the setpoint and a pull to where it leads: the vehicle overshoots, and returns after a stop.
void setArduCopter40(QuadrotorParams& vehicle, OdometryParams& odometry) {
  vehicle.velocity_gain = 1.03;
  vehicle.yaw_rate_gain = 1.02;
  vehicle.yaw_time_constant_sec = 0.36;
  vehicle.setpoint_acceleration_mps2 = 1.235;
  vehicle.acceleration_feed_forward = 0.19;
  vehicle.position_hold_per_sec = 0.36;
  vehicle.velocity_time_constant_sec = 0.636;
  vehicle.velocity_integral_per_sec = 0.3;
  vehicle.attitude_time_constant_sec = 0.05;
  vehicle.command_timeout_sec = 3.2;
  setBoundedOdometry(0.020, odometry);
  odometry.stamp_offset_sec = 0.08;
  odometry.latency_sec = 0.085;
  odometry.burst_period_sec = 0.034;
}

// As setArduCopter40, but with default WPNAV_ACCEL and gyro drift: slower changes, biased velocity and
// heading.
void setArduCopter40AsShipped(QuadrotorParams& vehicle, OdometryParams& odometry) {
  setArduCopter40(vehicle, odometry);
  vehicle.setpoint_acceleration_mps2 = 1.0;
  odometry.velocity_bias_mps = 0.115;
  odometry.velocity_bias_spread_mps = 0.075;
  odometry.own_bias_part = 1.0;
  odometry.heading_error_rad = 0.08;
}

// The setpoint has limits on acceleration and jerk and is fed forward: no overshoot, a slow end.
void setArduCopter43(QuadrotorParams& vehicle, OdometryParams& odometry) {
  vehicle.velocity_gain = 1.012;
  vehicle.yaw_rate_gain = 0.84;
  vehicle.setpoint_acceleration_mps2 = 1.494;
  vehicle.setpoint_time_constant_sec = 0.634;
  vehicle.setpoint_jerk_mps3 = 9.2;
  vehicle.acceleration_feed_forward = 1.0;
  vehicle.velocity_time_constant_sec = 0.62;
  vehicle.velocity_integral_per_sec = 0.5;
  vehicle.attitude_time_constant_sec = 0.05;
  vehicle.command_timeout_sec = 3.2;
  setBoundedOdometry(0.009, odometry);
  odometry.stamp_offset_sec = 0.03;
  odometry.latency_sec = 0.035;
  odometry.jitter_sec = 0.015;
}

// PX4's default gains (MPC_XY_VEL_P_ACC 1.8, _I_ACC 0.4). Velocity in OFFBOARD holds no place.
void setPx4Gps(QuadrotorParams& vehicle, OdometryParams& odometry) {
  vehicle.velocity_time_constant_sec = 0.55;
  vehicle.velocity_integral_per_sec = 0.22;
  vehicle.max_acceleration_mps2 = 5.0;
  vehicle.max_tilt_rad = 0.78;
  vehicle.command_timeout_sec = 1.0;
  setBoundedOdometry(0.15, odometry);
  odometry.rate_hz = 30.0;
  odometry.wander_correlation_sec = 10.0;
  odometry.velocity_bias_mps = 0.05;
  odometry.velocity_bias_spread_mps = 0.03;
  odometry.velocity_wander_mps = 0.12;
  odometry.own_bias_part = 1.0;
  odometry.stamp_offset_sec = 0.17;
  odometry.latency_sec = 0.01;
  odometry.jitter_sec = 0.07;
}

void setCrisp(QuadrotorParams& vehicle, OdometryParams& odometry) {
  vehicle.acceleration_feed_forward = 0.03;
  vehicle.position_hold_per_sec = 0.34;
  vehicle.velocity_time_constant_sec = 0.095;
  vehicle.velocity_integral_per_sec = 0.18;
  vehicle.max_acceleration_mps2 = 2.89;
  vehicle.max_tilt_rad = 0.57;
  vehicle.attitude_time_constant_sec = 0.058;
  vehicle.max_tilt_rate_radps = 13.8;
  vehicle.command_timeout_sec = 1.0;
  odometry = OdometryParams();
  odometry.rate_hz = 100.0;
  odometry.latency_sec = 0.002;
  odometry.jitter_sec = 0.003;
  odometry.position_noise_m = odometry.velocity_noise_mps = odometry.attitude_noise_rad = 0.0;
  odometry.drift_m_per_sqrt_sec = odometry.height_drift_m_per_sqrt_sec = 0.0;
  odometry.yaw_drift_rad_per_sqrt_sec = 0.0;
  odometry.twist_frame = "world";
}

}  // namespace

void applyProfile(const std::string& profile, QuadrotorParams& vehicle, OdometryParams& odometry) {
  vehicle.profile = profile;
  if (profile == "arducopter_4_0") setArduCopter40(vehicle, odometry);
  if (profile == "arducopter_4_0_default") setArduCopter40AsShipped(vehicle, odometry);
  if (profile == "arducopter_4_3") setArduCopter43(vehicle, odometry);
  if (profile == "crisp") setCrisp(vehicle, odometry);
  if (profile == "px4_1_13_gps") setPx4Gps(vehicle, odometry);
  if (profile == "slow") vehicle.setpoint_acceleration_mps2 = 0.6;
}

}  // namespace window_ingress::simulation
