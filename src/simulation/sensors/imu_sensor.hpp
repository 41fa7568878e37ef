#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <optional>

#include "simulation/random_stream.hpp"
#include "simulation/scenario/sensor_params.hpp"
#include "simulation/schedule.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// Noisy output of the attitude estimator and the inertial sensors.
struct ImuSample {
  double stamp_sec = 0.0;
  Eigen::Quaterniond R_odom_base = Eigen::Quaterniond::Identity();
  Eigen::Vector3d angular_velocity_base_radps = Eigen::Vector3d::Zero();
  Eigen::Vector3d specific_force_base_mps2 = Eigen::Vector3d::Zero();  ///< at rest: +g on z (REP 145)
};

/// Attitude with a slowly varying error of roll and pitch (first-order Gauss-Markov), white noise on rates
/// and forces, and constant biases of roll, pitch and gyroscope. The heading is that of the drifted odometry.
class ImuSensor {
 public:
  ImuSensor(const ImuParams& params, std::uint32_t seed)
      : params_(params),
        random_(seed, "imu"),
        periodic_(params.rate_hz),
        tilt_rad_(random_.normals(params.attitude_noise_rad).cwiseProduct(Eigen::Vector3d(1, 1, 0))),
        gyro_bias_radps_(RandomStream(seed, "imu bias").normals(params.gyro_bias_radps)) {}

  /// Call at each physics step. `odometry_drift`: see `OdometrySensor::drift`.
  void update(double now_sec, const VehicleTruth& truth, const Eigen::Vector3d& specific_force_base_mps2,
              const Eigen::Isometry3d& odometry_drift) {
    if (!periodic_.due(now_sec)) return;
    const double correlation_sec = std::max(params_.attitude_correlation_sec, 1e-6);
    const double kept = std::exp(-1.0 / (params_.rate_hz * correlation_sec));
    const Eigen::Vector3d fresh = random_.normals(params_.attitude_noise_rad * std::sqrt(1.0 - kept * kept));
    tilt_rad_ = kept * tilt_rad_ + Eigen::Vector3d(fresh.x(), fresh.y(), 0.0);

    ImuSample sample;
    sample.stamp_sec = now_sec + params_.stamp_offset_sec;
    Eigen::Matrix3d attitude = odometry_drift.linear() * truth.T_odom_base.linear();
    const Eigen::Vector3d tilt =
        tilt_rad_ + Eigen::Vector3d(params_.roll_bias_rad, params_.pitch_bias_rad, 0.0);
    if (tilt.norm() > 0.0)
      attitude = attitude * Eigen::AngleAxisd(tilt.norm(), tilt.normalized()).toRotationMatrix();
    sample.R_odom_base = Eigen::Quaterniond(attitude).normalized();
    sample.angular_velocity_base_radps =
        truth.angular_velocity_base_radps + gyro_bias_radps_ + random_.normals(params_.gyro_noise_radps);
    sample.specific_force_base_mps2 =
        specific_force_base_mps2 + random_.normals(params_.accelerometer_noise_mps2);
    delay_.push(now_sec + params_.latency_sec, sample);
  }

  /// Takes the oldest sample that has arrived; call until empty.
  std::optional<ImuSample> take(double now_sec) { return delay_.take(now_sec); }

 private:
  ImuParams params_;
  RandomStream random_;
  Periodic periodic_;
  DelayLine<ImuSample> delay_;
  Eigen::Vector3d tilt_rad_, gyro_bias_radps_;
};

}  // namespace window_ingress::simulation
