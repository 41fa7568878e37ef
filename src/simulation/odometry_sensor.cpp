#include "window_ingress/simulation/odometry_sensor.hpp"

#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {

OdometrySensor::OdometrySensor(const OdometryParams& params, std::uint32_t seed)
    : params_(params),
      walk_random_(seed, "odometry drift"),
      noise_random_(seed, "odometry noise"),
      periodic_(params.rate_hz),
      delay_(params.latency_sec) {}

void OdometrySensor::update(double now_sec, const VehicleTruth& truth) {
  if (!periodic_.due(now_sec)) return;
  walk(truth.T_odom_base.translation());
  delay_.push(now_sec, measure(now_sec, truth));
}

void OdometrySensor::walk(const Eigen::Vector3d& position) {
  const double root_sec = std::sqrt(1.0 / params_.rate_hz);
  const Eigen::Vector3d before = drift_ * position;
  const double yaw_rad = walk_random_.normal(params_.yaw_drift_rad_per_sqrt_sec * root_sec);
  Eigen::Vector3d step;
  step.x() = walk_random_.normal(params_.drift_m_per_sqrt_sec * root_sec);
  step.y() = walk_random_.normal(params_.drift_m_per_sqrt_sec * root_sec);
  step.z() = walk_random_.normal(params_.height_drift_m_per_sqrt_sec * root_sec);
  const Eigen::Matrix3d turned = geometry::yawRotation(yaw_rad) * drift_.linear();
  drift_ = geometry::makePose(turned, before + step - turned * position);
}

Eigen::Vector3d OdometrySensor::noise(double sigma) {
  const double x = noise_random_.normal(sigma), y = noise_random_.normal(sigma),
               z = noise_random_.normal(sigma);
  return {x, y, z};
}

OdometrySample OdometrySensor::measure(double now_sec, const VehicleTruth& truth) {
  OdometrySample sample;
  sample.stamp_sec = now_sec;
  sample.T_odom_base = drift_ * truth.T_odom_base;
  sample.T_odom_base.translation() += noise(params_.position_noise_m);
  const Eigen::Vector3d tilt = noise(params_.attitude_noise_rad);
  if (tilt.norm() > 0.0) sample.T_odom_base.rotate(Eigen::AngleAxisd(tilt.norm(), tilt.normalized()));
  sample.velocity_odom_mps = drift_.linear() * truth.velocity_odom_mps + noise(params_.velocity_noise_mps);
  sample.angular_velocity_base_radps = truth.angular_velocity_base_radps;
  return sample;
}

}  // namespace window_ingress::simulation
