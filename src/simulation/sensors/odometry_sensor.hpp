#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/schedule.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// What the vehicle's odometry says: noisy, drifting.
struct OdometrySample {
  double stamp_sec = 0.0;
  Eigen::Isometry3d T_odom_base = Eigen::Isometry3d::Identity();
  Eigen::Vector3d velocity_odom_mps = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_base_radps = Eigen::Vector3d::Zero();
};

/// White noise on everything, over an error that comes and goes and a slow random walk of position and
/// heading. Heading walks about the vehicle, so that it does not throw the position about. Horizontal
/// movement may be reported too long or too short (`scale_error`), velocity be off by a constant that turns
/// with the vehicle (`velocity_bias_mps`) and by one that comes and goes (`velocity_wander_mps`), heading by
/// another one (`heading_error_rad`), neither of which its positions show; horizontal errors grow with height
/// and lack of texture, as those of optical flow do.
class OdometrySensor {
 public:
  OdometrySensor(const OdometryParams& params, std::uint32_t seed);

  void update(double now_sec, const VehicleTruth& truth);  ///< at each physics step
  /// The oldest sample that has arrived and was not taken; ask until there is none.
  std::optional<OdometrySample> take(double now_sec) { return delivery_.take(now_sec); }

  /// Pose of the true odometry frame in the drifted one: `p_reported = drift() * p_true`, where the vehicle
  /// is.
  const Eigen::Isometry3d& drift() const { return drift_; }
  /// What the vehicle itself believes at the time of the last update, on board and so without latency: with
  /// scale and noise of the last sample, `estimate_delay_sec` old. Axes of the drifted odometry [m/s].
  Eigen::Vector3d velocityEstimate() const;

 private:
  void walk(const Eigen::Vector3d& position);
  void wander(double spread, double correlation_sec, RandomStream& random, Eigen::Vector3d& error) const;
  void deliver(double now_sec, const OdometrySample& sample);
  OdometrySample measure(double now_sec, const VehicleTruth& truth);
  Eigen::Vector3d scaled(const Eigen::Vector3d& velocity_mps) const;
  Eigen::Vector3d drawBias(std::uint32_t seed) const;

  OdometryParams params_;
  RandomStream walk_random_, noise_random_, wander_random_, velocity_wander_random_, delivery_random_;
  Periodic periodic_;
  DelayLine<OdometrySample> delivery_;
  DelayLine<Eigen::Vector3d> own_velocity_;  // true velocities on their way to the vehicle's own estimate
  Eigen::Isometry3d drift_ = Eigen::Isometry3d::Identity();
  std::optional<Eigen::Vector3d> last_position_;
  double flow_factor_ = 1.0;  // of horizontal errors
  double heading_error_rad_;
  Eigen::Vector3d velocity_bias_base_mps_, own_bias_mps_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d wander_m_ = Eigen::Vector3d::Zero(), velocity_wander_mps_ = Eigen::Vector3d::Zero(),
                  velocity_noise_mps_ = Eigen::Vector3d::Zero(),
                  delayed_velocity_mps_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::simulation
