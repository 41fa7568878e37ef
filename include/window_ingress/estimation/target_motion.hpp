#pragma once

#include <Eigen/Core>

namespace window_ingress::estimation {

/// What a moving target may do. Each component of its velocity is an Ornstein-Uhlenbeck process: Gaussian
/// about zero with a standard deviation of `speed_mps`, forgotten exponentially within `time_sec`. A target
/// that swings to and fro is followed well with a `time_sec` of about half of its period.
struct MotionModel {
  double speed_mps = 0.0;  ///< 0: it stands still
  double time_sec = 2.0;

  bool stands() const { return !(speed_mps > 0.0); }

  /// What a while does to place and velocity along one axis: x += way_sec v + noise, v = kept v + noise.
  struct While {
    double kept = 1.0;
    double way_sec = 0.0;
    double place_variance = 0.0, cross_covariance = 0.0, velocity_variance = 0.0;  ///< of the noise
  };
  While over(double elapsed_sec) const;  ///< nothing happens for elapsed_sec <= 0
};

/// What is known of a target's motion at one moment.
struct TargetMotion {
  MotionModel model;
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double velocity_sigma_mps = 0.0;  ///< of its worst known direction
};

}  // namespace window_ingress::estimation
