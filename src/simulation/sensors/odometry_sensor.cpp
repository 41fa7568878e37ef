#include "simulation/sensors/odometry_sensor.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {
namespace {

constexpr double kMinTexture = 0.05;

Eigen::Vector3d horizontalTimes(double factor, const Eigen::Vector3d& v) {
  return {factor * v.x(), factor * v.y(), v.z()};
}

Eigen::Vector3d drawBias(const OdometryParams& params, std::uint32_t seed) {
  RandomStream random(seed, "odometry velocity bias");
  const double towards_rad = random.uniform(-M_PI, M_PI);
  const double size_mps =
      params.velocity_bias_mps + params.velocity_bias_spread_mps * random.uniform(-1.0, 1.0);
  return std::max(0.0, size_mps) * Eigen::Vector3d(std::cos(towards_rad), std::sin(towards_rad), 0.0);
}

}  // namespace

OdometrySensor::OdometrySensor(const OdometryParams& params, std::uint32_t seed)
    : params_(params),
      walk_random_(seed, "odometry drift"),
      noise_random_(seed, "odometry noise"),
      wander_random_(seed, "odometry wander"),
      velocity_wander_random_(seed, "odometry velocity wander"),
      delivery_random_(seed, "odometry delivery"),
      periodic_(params.rate_hz),
      heading_error_rad_(params.heading_error_rad *
                         RandomStream(seed, "odometry heading error").uniform(-1.0, 1.0)),
      velocity_bias_base_mps_(drawBias(params, seed)) {
  for (int axis = 0; axis < 2; ++axis) wander_m_[axis] = wander_random_.normal(params.wander_m);
  for (int axis = 0; axis < 2; ++axis)
    velocity_wander_mps_[axis] = velocity_wander_random_.normal(params.velocity_wander_mps);
}

void OdometrySensor::update(double now_sec, const VehicleTruth& truth) {
  own_velocity_.push(now_sec + params_.estimate_delay_sec, truth.velocity_odom_mps);
  while (const auto velocity = own_velocity_.take(now_sec)) delayed_velocity_mps_ = *velocity;
  if (!periodic_.due(now_sec)) return;
  const double height_m = std::max(0.0, truth.T_odom_base.translation().z());
  flow_factor_ =
      (1.0 + params_.height_factor_per_m * height_m) / std::max(params_.texture_quality, kMinTexture);
  walk(truth.T_odom_base.translation());
  wander(params_.wander_m, params_.wander_correlation_sec, wander_random_, wander_m_);
  wander(params_.velocity_wander_mps, params_.velocity_wander_correlation_sec, velocity_wander_random_,
         velocity_wander_mps_);
  deliver(now_sec, measure(now_sec, truth));
}

Eigen::Vector3d OdometrySensor::velocityEstimate() const {
  return drift_.linear() * scaled(delayed_velocity_mps_) + velocity_noise_mps_ + own_bias_mps_;
}

Eigen::Vector3d OdometrySensor::scaled(const Eigen::Vector3d& velocity_mps) const {
  return horizontalTimes(1.0 + params_.scale_error, velocity_mps);
}

void OdometrySensor::walk(const Eigen::Vector3d& position) {
  const double root_sec = std::sqrt(1.0 / params_.rate_hz);
  const Eigen::Vector3d moved = position - last_position_.value_or(position);
  const Eigen::Vector3d before = drift_ * position + drift_.linear() * (scaled(moved) - moved);
  last_position_ = position;
  const double yaw_rad = walk_random_.normal(params_.yaw_drift_rad_per_sqrt_sec * root_sec);
  Eigen::Vector3d step;
  step.x() = walk_random_.normal(params_.drift_m_per_sqrt_sec * root_sec);
  step.y() = walk_random_.normal(params_.drift_m_per_sqrt_sec * root_sec);
  step.z() = walk_random_.normal(params_.height_drift_m_per_sqrt_sec * root_sec);
  const Eigen::Matrix3d turned = geometry::yawRotation(yaw_rad) * drift_.linear();
  drift_ = geometry::makePose(turned, before + horizontalTimes(flow_factor_, step) - turned * position);
}

// A first-order Gauss-Markov process: its spread stays constant.
void OdometrySensor::wander(double spread, double correlation_sec, RandomStream& random,
                            Eigen::Vector3d& error) const {
  const double kept = std::exp(-1.0 / (params_.rate_hz * correlation_sec));
  const double fresh = spread * std::sqrt(1.0 - kept * kept);
  for (int axis = 0; axis < 2; ++axis) error[axis] = kept * error[axis] + random.normal(fresh);
}

void OdometrySensor::deliver(double now_sec, const OdometrySample& sample) {
  double arrival_sec =
      now_sec + params_.latency_sec + params_.jitter_sec * delivery_random_.uniform(0.0, 1.0);
  const double period_sec = params_.burst_period_sec;
  if (period_sec > 0.0) arrival_sec = std::ceil(arrival_sec / period_sec - 1e-9) * period_sec;
  delivery_.push(arrival_sec, sample);
}

OdometrySample OdometrySensor::measure(double now_sec, const VehicleTruth& truth) {
  OdometrySample sample;
  sample.stamp_sec = now_sec + params_.stamp_offset_sec;
  sample.T_odom_base = drift_ * truth.T_odom_base;
  sample.T_odom_base.translation() +=
      wander_m_ + horizontalTimes(flow_factor_, noise_random_.normals(params_.position_noise_m));
  sample.T_odom_base.linear() = geometry::yawRotation(heading_error_rad_) * sample.T_odom_base.linear();
  const Eigen::Vector3d tilt = noise_random_.normals(params_.attitude_noise_rad);
  if (tilt.norm() > 0.0) sample.T_odom_base.rotate(Eigen::AngleAxisd(tilt.norm(), tilt.normalized()));
  velocity_noise_mps_ = horizontalTimes(flow_factor_, noise_random_.normals(params_.velocity_noise_mps));
  const Eigen::Vector3d error_mps =
      geometry::yawRotation(geometry::yawOf(sample.T_odom_base.linear())) * velocity_bias_base_mps_ +
      velocity_wander_mps_;
  own_bias_mps_ = params_.own_bias_part * error_mps;
  sample.velocity_odom_mps =
      drift_.linear() * scaled(truth.velocity_odom_mps) + velocity_noise_mps_ + error_mps;
  sample.angular_velocity_base_radps = truth.angular_velocity_base_radps;
  return sample;
}

}  // namespace window_ingress::simulation
