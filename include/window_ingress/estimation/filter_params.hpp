#pragma once

#include "window_ingress/estimation/target_motion.hpp"

namespace window_ingress::estimation {

/// Parameters of `WindowFilter`.
struct FilterParams {
  double known_size_sigma = 0.003;  ///< relative error of a size that is called known
  double scale_speed_mps = 0.1;     ///< slower than this, the way flown tells nothing about the size [m/s]

  double systematic_sigma_px =
      0.15;  ///< error of a corner that is the same in all images from one place [px]
  double unknown_corner_sigma_px = 1.0;  ///< taken where an observation brings no usable covariance [px]
  double systematic_renewal_m = 0.5;     ///< the systematic error is a new one this far away [m]
  double systematic_renewal_sec = 20.0;  ///< and after this time at one place [s]

  double odom_position_sigma_m = 0.01;     ///< noise of each camera position, latency included [m]
  double odom_attitude_sigma_rad = 0.004;  ///< noise of each camera attitude, latency included [rad]
  double attitude_bias_sigma_rad = 0.02;   ///< lasting error of roll and pitch, mounting included [rad]
  double mounting_yaw_sigma_rad = 0.005;   ///< lasting error of the camera's heading on the vehicle [rad]
  double attitude_bias_time_sec = 20.0;    ///< how long that error lasts [s]
  double drift_m_per_sqrt_sec = 0.01;      ///< odometry's random walk in time [m/sqrt(s)]
  double drift_m_per_sqrt_m = 0.03;        ///< and in distance flown [m/sqrt(m)]
  double drift_rad_per_sqrt_sec = 0.002;   ///< and in heading [rad/sqrt(s)]
  double target_speed_mps =
      0.0;  ///< of a target that moves, root mean square a direction; 0: it stands [m/s]
  double target_speed_time_sec =
      2.0;  ///< how long its velocity lasts: half the period of one that swings [s]

  MotionModel targetMotion() const { return {target_speed_mps, target_speed_time_sec}; }

  double gate_squares = 35.0;  ///< largest normalised innovation squared; 8 degrees of freedom
  double max_mean_squares =
      20.0;  ///< the same, as a mean over some 30 images; beyond it the filter starts anew
  int outliers_until_restart = 5;  ///< consecutive images beyond the gate, after which the filter starts anew
  double max_evidence = 3.0;       ///< of one image for one hypothesis against the other [nats]
  double dead_weight = 0.001;      ///< a hypothesis below this weight is dropped
  double harmless_yaw_rad = 0.1;   ///< hypotheses nearer to each other than this need not be told apart [rad]
  double trusted_yaw_sigma_rad = 0.06;  ///< largest yaw spread of a trusted hypothesis [rad]

  int consistency_images = 50;   ///< of the window over which the filter's consistency is judged
  double max_consistency = 3.3;  ///< of the mean squared innovation a degree of freedom there; 1 is expected

  double max_age_sec = 10.0;   ///< without images for longer there is no state [s]
  double time_jump_sec = 1.0;  ///< an image this much older than the last one is a jump back in time [s]

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("known_size_sigma", self.known_size_sigma, 1e-4, 0.1);
    field("scale_speed_mps", self.scale_speed_mps, 0.01, 2.0);
    field("systematic_sigma_px", self.systematic_sigma_px, 0.001, 10.0);
    field("unknown_corner_sigma_px", self.unknown_corner_sigma_px, 0.01, 20.0);
    field("systematic_renewal_m", self.systematic_renewal_m, 0.001, 10.0);
    field("systematic_renewal_sec", self.systematic_renewal_sec, 0.1, 1000.0);
    field("odom_position_sigma_m", self.odom_position_sigma_m, 0.0, 1.0);
    field("odom_attitude_sigma_rad", self.odom_attitude_sigma_rad, 0.0, 0.5);
    field("attitude_bias_sigma_rad", self.attitude_bias_sigma_rad, 1e-4, 0.5);
    field("mounting_yaw_sigma_rad", self.mounting_yaw_sigma_rad, 1e-4, 0.5);
    field("attitude_bias_time_sec", self.attitude_bias_time_sec, 0.1, 10000.0);
    field("drift_m_per_sqrt_sec", self.drift_m_per_sqrt_sec, 0.0, 1.0);
    field("drift_m_per_sqrt_m", self.drift_m_per_sqrt_m, 0.0, 1.0);
    field("drift_rad_per_sqrt_sec", self.drift_rad_per_sqrt_sec, 0.0, 0.5);
    field("target_speed_mps", self.target_speed_mps, 0.0, 0.5);
    field("target_speed_time_sec", self.target_speed_time_sec, 0.2, 60.0);
    field("gate_squares", self.gate_squares, 10.0, 1000.0);
    field("max_mean_squares", self.max_mean_squares, 9.0, 1000.0);
    field("outliers_until_restart", self.outliers_until_restart, 1, 1000);
    field("max_evidence", self.max_evidence, 0.1, 50.0);
    field("dead_weight", self.dead_weight, 1e-9, 0.2);
    field("harmless_yaw_rad", self.harmless_yaw_rad, 0.0, 0.5);
    field("trusted_yaw_sigma_rad", self.trusted_yaw_sigma_rad, 0.001, 0.5);
    field("consistency_images", self.consistency_images, 5, 10000);
    field("max_consistency", self.max_consistency, 1.0, 100.0);
    field("max_age_sec", self.max_age_sec, 0.1, 1000.0);
    field("time_jump_sec", self.time_jump_sec, 0.01, 100.0);
  }
};

}  // namespace window_ingress::estimation
