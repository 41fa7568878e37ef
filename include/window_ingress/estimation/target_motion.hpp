#pragma once

#include <Eigen/Core>

namespace window_ingress::estimation {

/// Motion model of the target. Each component of its velocity is an Ornstein-Uhlenbeck process: Gaussian
/// about zero with a standard deviation of `speed_mps` and a correlation time of `time_sec`. About half the
/// period of a swinging target is a good `time_sec`.
struct MotionModel {
  double speed_mps = 0.0;  ///< 0: the target stands still
  double time_sec = 2.0;

  bool stands() const { return !(speed_mps > 0.0); }

  /// Effect of elapsed time on place and velocity along one axis: x += way_sec v + noise, v = kept v + noise.
  struct While {
    double kept = 1.0;
    double way_sec = 0.0;
    double place_variance = 0.0, cross_covariance = 0.0, velocity_variance = 0.0;  ///< of the noise
  };
  While over(double elapsed_sec) const;  ///< no effect for elapsed_sec <= 0
};

/// Estimate of a target's motion at one moment.
struct TargetMotion {
  MotionModel model;
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  double velocity_sigma_mps = 0.0;  ///< in its least known direction
};

/// Motion of a camera in odom axes; a wrong stamp displaces the camera along it.
struct CameraMotion {
  Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d turn_radps = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::estimation
