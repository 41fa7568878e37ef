#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/schedule.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// Noisy, drifting output of the vehicle's odometry.
struct OdometrySample {
  double stamp_sec = 0.0;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_base_radps = Eigen::Vector3d::Zero();
};

/// Simulates odometry errors: white noise on all values, a slowly varying position error, and a slow random
/// walk of position and heading. The heading walks about the vehicle, so that it does not move the position.
/// Horizontal motion may have a scale error (`scale_error`). The velocity may have a constant error that
/// turns with the vehicle (`velocity_bias_mps`) and a slowly varying one (`velocity_wander_mps`), the heading
/// a constant one (`heading_error_rad`); the positions show none of these. Horizontal errors grow with height
/// and lack of texture, as with optical flow.
class OdometrySensor {
 public:
  OdometrySensor(const OdometryParams& params, std::uint32_t seed);

  void update(double now_sec, const VehicleTruth& truth);  ///< call at each physics step
  /// Takes the oldest sample that has arrived; call until empty.
  std::optional<OdometrySample> take(double now_sec) { return delivery_.take(now_sec); }

  /// Pose of the true odometry frame in the drifted one, at the vehicle's place: `p_reported = drift() *
  /// p_true`.
  const Eigen::Isometry3d& drift() const { return drift_; }
  /// The vehicle's own velocity estimate at the last update, on board and so without latency: with scale and
  /// noise of the last sample, `estimate_delay_sec` old. Axes of the drifted odometry [m/s].
  Eigen::Vector3d velocityEstimate() const;

 private:
  void walk(const Eigen::Vector3d& position);
  void wander(double spread, double correlation_sec, RandomStream& random, Eigen::Vector3d& error) const;
  void deliver(double now_sec, const OdometrySample& sample);
  OdometrySample measure(double now_sec, const VehicleTruth& truth);
  Eigen::Vector3d scaled(const Eigen::Vector3d& velocity_mps) const;

  OdometryParams params_;
  RandomStream walk_random_, noise_random_, wander_random_, velocity_wander_random_, delivery_random_;
  Periodic periodic_;
  DelayLine<OdometrySample> delivery_;
  DelayLine<Eigen::Vector3d> own_velocity_;  // true velocities, delayed for the vehicle's own estimate
  Eigen::Isometry3d drift_ = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Vector3d> last_position_;
  double flow_factor_ = 1.0;  // factor on horizontal errors
  double heading_error_rad_;
  Eigen::Vector3d velocity_bias_base_mps_, own_bias_mps_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wander_m_ = Eigen::Vector3d::Zero(), velocity_wander_mps_ = Eigen::Vector3d::Zero(),
                  velocity_noise_mps_ = Eigen::Vector3d::Zero(),
                  delayed_velocity_mps_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::simulation
