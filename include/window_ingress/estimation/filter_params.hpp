#pragma once

#include "window_ingress/estimation/target_motion.hpp"

namespace window_ingress::estimation {

/// What the filter of the window's pose assumes of odometry, camera mounting and target.
struct FilterParams {
  double odom_position_sigma_m = 0.01;     ///< noise of each camera position, latency included [m]
  double odom_attitude_sigma_rad = 0.004;  ///< noise of each camera attitude, latency included [rad]
  double attitude_bias_sigma_rad = 0.02;  ///< lasting error of roll and pitch, camera mounting included [rad]
  double mounting_yaw_sigma_rad =
      0.03;  ///< lasting error of the camera's yaw on the vehicle, and of odometry's heading beside its
             ///< positions: an autopilot's compass is 3 to 5 degrees off; at most 0.001: the way flown is
             ///< not asked whether mounting and opening's size are as said [rad]
  double drift_m_per_sqrt_m = 0.03;  ///< odometry's random walk of position over distance flown [m/sqrt(m)]
  double drift_rad_per_sqrt_sec = 0.002;  ///< odometry's random walk of heading over time [rad/sqrt(s)]
  double target_speed_mps =
      0.0;  ///< speed of a moving window, root mean square per axis; 0: it stands still [m/s]
  double target_speed_time_sec = 2.0;  ///< time over which a moving window keeps its velocity: half the
                                       ///< period of one that swings [s]
  double nis_gate = 35.0;  ///< images with a larger normalised innovation squared (8 degrees of freedom) are
                           ///< outliers and change nothing
  double max_age_sec = 10.0;  ///< without images for longer than this the filter has no state [s]

  // Not in `visit`: said elsewhere, or opened by the check of the mounting.
  double systematic_sigma_px = 0.15;     // `PoseParams::systematic_sigma_px`
  double drift_m_per_sqrt_sec = 0.01;    // config/vehicle.yaml
  double attitude_bias_time_sec = 20.0;  // how long the lasting error of roll and pitch lasts
  bool yaw_bias_lasts = true;            // what was found of it outlives a new start
  double trusted_yaw_sigma_rad = 0.06;   // largest of a trusted hypothesis
  double heading_bias_sigma_rad = 1e-6;  // of odometry beside its positions, if not learned with the yaw
  int outliers_until_restart = 5;        // in a row

  static constexpr double kKnownSizeSigma = 0.003;  ///< relative error of a size that is called known
  static constexpr double kSystematicRenewalM =
      0.5;  ///< a corner's systematic error is a new one this far away

  MotionModel targetMotion() const { return {target_speed_mps, target_speed_time_sec}; }

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("odom_position_sigma_m", self.odom_position_sigma_m, 0.0, 1.0);
    field("odom_attitude_sigma_rad", self.odom_attitude_sigma_rad, 0.0, 0.5);
    field("attitude_bias_sigma_rad", self.attitude_bias_sigma_rad, 1e-4, 0.5);
    field("mounting_yaw_sigma_rad", self.mounting_yaw_sigma_rad, 1e-4, 0.5);
    field("drift_m_per_sqrt_m", self.drift_m_per_sqrt_m, 0.0, 1.0);
    field("drift_rad_per_sqrt_sec", self.drift_rad_per_sqrt_sec, 0.0, 0.5);
    field("target_speed_mps", self.target_speed_mps, 0.0, 0.5);
    field("target_speed_time_sec", self.target_speed_time_sec, 0.2, 60.0);
    field("nis_gate", self.nis_gate, 10.0, 1000.0);
    field("max_age_sec", self.max_age_sec, 0.1, 1000.0);
  }
};

}  // namespace window_ingress::estimation
