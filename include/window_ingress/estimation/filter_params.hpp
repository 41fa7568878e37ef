#pragma once

#include "window_ingress/estimation/target_motion.hpp"

namespace window_ingress::estimation {

/// Assumptions of the window filter about odometry, camera mounting and target.
struct FilterParams {
  double odom_position_sigma_m = 0.01;     ///< noise of each camera position, latency included [m]
  double odom_attitude_sigma_rad = 0.004;  ///< noise of each camera attitude, latency included [rad]
  double attitude_bias_sigma_rad = 0.02;   ///< systematic error of roll and pitch, mounting included [rad]
  double mounting_yaw_sigma_rad = 0.03;    ///< systematic error of the camera's yaw, and of odometry's
                                           ///< heading against its positions (a compass is 3 to 5 degrees
                                           ///< off); up to 0.001: mounting and size are not verified in
                                           ///< flight [rad]
  double drift_m_per_sqrt_m = 0.03;  ///< random walk of odometry's position over distance flown [m/sqrt(m)]
  double drift_rad_per_sqrt_sec = 0.002;  ///< random walk of odometry's heading over time [rad/sqrt(s)]
  double target_speed_mps = 0.0;  ///< speed of a moving window, rms per axis; 0: the window is fixed [m/s]
  double target_speed_time_sec = 2.0;  ///< time a moving window keeps its velocity: half the period of a
                                       ///< swing [s]
  double nis_gate = 35.0;  ///< images with a larger normalised innovation squared (8 degrees of freedom) are
                           ///< outliers and are ignored
  double max_age_sec = 10.0;  ///< the filter's state expires this long after the last image [s]

  // Not in `visit`: set elsewhere, or changed by the check of the mounting.
  double systematic_sigma_px = 0.15;     // `PoseParams::systematic_sigma_px`
  double drift_m_per_sqrt_sec = 0.01;    // config/vehicle.yaml
  double attitude_bias_time_sec = 20.0;  // correlation time of the systematic error of roll and pitch
  bool yaw_bias_lasts = true;            // the estimated yaw error survives a restart
  double trusted_yaw_sigma_rad = 0.06;   // upper limit for a trusted hypothesis
  double heading_bias_sigma_rad = 1e-6;  // of odometry against its positions, if not learned with the yaw
  int outliers_until_restart = 5;        // in a row

  static constexpr double kKnownSizeSigma = 0.003;  ///< relative error of a size that counts as known
  static constexpr double kSystematicRenewalM =
      0.5;  ///< systematic errors of one corner are independent this far apart

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
