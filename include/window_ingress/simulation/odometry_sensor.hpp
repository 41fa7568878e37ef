#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/simulation/random_stream.hpp"
#include "window_ingress/simulation/schedule.hpp"
#include "window_ingress/simulation/sensor_params.hpp"
#include "window_ingress/simulation/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// What the vehicle's odometry says: noisy, drifting.
struct OdometrySample {
  double stamp_sec = 0.0;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_base_radps = Eigen::Vector3d::Zero();
};

/// White noise on everything, over a slow random walk of position and heading. Heading walks about the
/// vehicle, so that it does not throw the position about.
class OdometrySensor {
 public:
  OdometrySensor(const OdometryParams& params, std::uint32_t seed);

  void update(double now_sec, const VehicleTruth& truth);  ///< at each physics step
  std::optional<OdometrySample> take(double now_sec) { return delay_.take(now_sec); }

  /// Pose of the true odometry frame in the drifted one: `p_reported = drift() * p_true`.
  const Eigen::Isometry3d& drift() const { return drift_; }

 private:
  void walk(const Eigen::Vector3d& position);
  OdometrySample measure(double now_sec, const VehicleTruth& truth);
  Eigen::Vector3d noise(double sigma);

  OdometryParams params_;
  RandomStream walk_random_, noise_random_;
  Periodic periodic_;
  DelayLine<OdometrySample> delay_;
  Eigen::Isometry3d drift_ = Eigen::Isometry3d::Identity();
};

}  // namespace window_ingress::simulation
