#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/schedule.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// What the attitude estimator says: noisy.
struct ImuSample {
  double stamp_sec = 0.0;
  Eigen::Quaterniond R_odom_base = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_base_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_base_mps2 = Eigen::Vector3d::Zero();  ///< at rest: +g on z (REP 145)
};

/// Attitude with an error of roll and pitch that lasts for a while (first-order Gauss-Markov), white noise on
/// rates and forces, constant biases of roll, pitch and the gyroscope. Its heading is that of the drifted
/// odometry.
class ImuSensor {
 public:
  ImuSensor(const ImuParams& params, std::uint32_t seed);

  /// At each physics step. `odometry_drift`: see `OdometrySensor::drift`.
  void update(double now_sec, const VehicleTruth& truth, const Eigen::Vector3d& specific_force_base_mps2,
              const Eigen::Isometry3d& odometry_drift);
  /// The oldest sample that has arrived and was not taken; ask until there is none.
  std::optional<ImuSample> take(double now_sec) { return delay_.take(now_sec); }

 private:
  ImuParams params_;
  RandomStream random_;
  Periodic periodic_;
  DelayLine<ImuSample> delay_;
  Eigen::Vector3d tilt_rad_, gyro_bias_radps_;
};

}  // namespace window_ingress::simulation
