#include "simulation/sensors/imu_sensor.hpp"

#include <cmath>

namespace window_ingress::simulation {

ImuSensor::ImuSensor(const ImuParams& params, std::uint32_t seed)
    : params_(params),
      random_(seed, "imu"),
      periodic_(params.rate_hz),
      delay_(params.latency_sec),
      tilt_rad_(random_.normals(params.attitude_noise_rad).cwiseProduct(Eigen::Vector3d(1, 1, 0))) {
  RandomStream bias(seed, "imu bias");
  for (int axis = 0; axis < 3; ++axis) gyro_bias_radps_[axis] = bias.normal(params.gyro_bias_radps);
}

void ImuSensor::update(double now_sec, const VehicleTruth& truth,
                       const Eigen::Vector3d& specific_force_base_mps2,
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
  delay_.push(now_sec, sample);
}

}  // namespace window_ingress::simulation
