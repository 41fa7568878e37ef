#include "simulation/vehicle/quadrotor.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {
namespace {

// Bounds of the commanded thrust, as acceleration.
constexpr double kMinThrust_mps2 = 0.2 * kGravity_mps2, kMaxThrust_mps2 = 2.0 * kGravity_mps2;
constexpr double kMotorTimeConstant_sec = 0.04;

// Fraction of a step that a first-order lag follows in one time step.
double lagPart(double step_sec, double time_constant_sec) {
  return 1.0 - std::exp(-step_sec / time_constant_sec);
}

// Keeps the vertical part and limits the horizontal one.
Eigen::Vector3d limitTilt(Eigen::Vector3d force, double max_tilt_rad) {
  force.z() = std::clamp(force.z(), kMinThrust_mps2, kMaxThrust_mps2);
  force.head<2>() *=
      std::min(1.0, std::tan(max_tilt_rad) * force.z() / std::max(force.head<2>().norm(), 1e-9));
  return force;
}

Eigen::Matrix3d attitudeFor(const Eigen::Vector3d& force, double yaw_rad) {
  const Eigen::Vector3d up = force.normalized();
  const Eigen::Vector3d heading(std::cos(yaw_rad), std::sin(yaw_rad), 0);
  const Eigen::Vector3d left = up.cross(heading).normalized();
  Eigen::Matrix3d attitude;
  attitude << left.cross(up), left, up;
  return attitude;
}

}  // namespace

Quadrotor::Quadrotor(const QuadrotorParams& params, const Eigen::Isometry3d& T_odom_base,
                     const Eigen::Vector3d& wind_odom_mps)
    : params_(params),
      thrust_gain_((1.0 + params.thrust_gain_error) / params.massRatio()),
      motor_command_mps2_(kGravity_mps2 / thrust_gain_),
      controller_(params),
      rest_height_m_(params.half_height_m) {
  truth_.T_odom_base = T_odom_base;
  const Eigen::Vector3d gravity(0, 0, kGravity_mps2);
  hover_trim_mps2_ = gravity / thrust_gain_ - gravity;
  controller_.setTrim(hover_trim_mps2_);
  if (T_odom_base.translation().z() <= params.half_height_m + 1e-6) return;
  const Eigen::Vector3d against_wind =
      -params.drag_per_sec / params.massRatio() / thrust_gain_ * wind_odom_mps;
  controller_.setTrim(hover_trim_mps2_ + against_wind);
  const Eigen::Vector3d force = limitTilt(controller_.trim() + gravity, params.max_tilt_rad);
  truth_.T_odom_base.linear() = attitudeFor(force, geometry::yawOf(T_odom_base.linear()));
  motor_command_mps2_ = force.norm();
  specific_force_base_mps2_ = truth_.T_odom_base.linear().transpose() * gravity;
}

void Quadrotor::command(const VelocityCommand& command) {
  if (!command.velocity_odom_mps.allFinite() || !std::isfinite(command.yaw_rate_radps)) return;
  command_.velocity_odom_mps = shortened(command.velocity_odom_mps, params_.max_speed_mps);
  command_.yaw_rate_radps =
      std::clamp(command.yaw_rate_radps, -params_.max_yaw_rate_radps, params_.max_yaw_rate_radps);
  command_age_sec_ = 0.0;
}

void Quadrotor::step(double step_sec, const Air& air, const Eigen::Vector3d& estimated_velocity_odom_mps) {
  command_age_sec_ += step_sec;
  if (command_age_sec_ > params_.command_timeout_sec) command_ = VelocityCommand();
  if (crashed_) {
    move(0.0, air, step_sec);
  } else {
    const Eigen::Vector3d force = wantedForce(estimated_velocity_odom_mps, step_sec);
    turn(force, step_sec);
    const double thrust_mps2 =
        std::clamp(force.dot(truth_.T_odom_base.linear().col(2)), kMinThrust_mps2, kMaxThrust_mps2);
    motor_command_mps2_ += lagPart(step_sec, kMotorTimeConstant_sec) * (thrust_mps2 - motor_command_mps2_);
    move(thrust_gain_ * motor_command_mps2_, air, step_sec);
  }
  standOnGround();
}

void Quadrotor::crash(double rest_height_m) {
  if (crashed_) return;
  crashed_ = true;
  rest_height_m_ = std::max(rest_height_m, params_.half_height_m);
  truth_.velocity_odom_mps.setZero();
  truth_.angular_velocity_base_radps.setZero();
}

Eigen::Vector3d Quadrotor::wantedForce(const Eigen::Vector3d& velocity_mps, double step_sec) {
  const Eigen::Vector3d known_drag = params_.drag_per_sec * velocity_mps;
  const Eigen::Vector3d force = controller_.step(command_.velocity_odom_mps, velocity_mps, step_sec) +
                                known_drag + Eigen::Vector3d(0, 0, kGravity_mps2);
  return limitTilt(force, params_.max_tilt_rad);
}

void Quadrotor::turn(const Eigen::Vector3d& force, double step_sec) {
  const Eigen::Matrix3d& attitude = truth_.T_odom_base.linear();
  const Eigen::Matrix3d wanted = attitudeFor(force, geometry::yawOf(attitude));
  const Eigen::AngleAxisd error(Eigen::Matrix3d(attitude.transpose() * wanted));
  const double gain = (1.0 + params_.attitude_gain_error) / params_.attitude_time_constant_sec;
  Eigen::Vector3d rate = gain * error.angle() * error.axis();
  rate.head<2>() *= std::min(1.0, params_.max_tilt_rate_radps / std::max(rate.head<2>().norm(), 1e-9));
  rate.z() = params_.yaw_rate_gain * command_.yaw_rate_radps;

  Eigen::Vector3d& omega = truth_.angular_velocity_base_radps;
  omega.head<2>() += lagPart(step_sec, kRateTimeConstant_sec) * (rate - omega).head<2>();
  omega.z() += lagPart(step_sec, params_.yaw_time_constant_sec) * (rate.z() - omega.z());
  const double angle = omega.norm() * step_sec;
  if (angle < 1e-12) return;
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(attitude) * Eigen::Quaterniond(Eigen::AngleAxisd(angle, omega.normalized()));
  truth_.T_odom_base.linear() = turned.normalized().toRotationMatrix();
}

void Quadrotor::move(double thrust_mps2, const Air& air, double step_sec) {
  const Eigen::Matrix3d& attitude = truth_.T_odom_base.linear();
  const Eigen::Vector3d drag = params_.drag_per_sec * (air.wind_mps - truth_.velocity_odom_mps);
  const Eigen::Vector3d push = crashed_ ? Eigen::Vector3d::Zero() : air.push_mps2;
  const Eigen::Vector3d specific_force = thrust_mps2 * attitude.col(2) + (drag + push) / params_.massRatio();
  specific_force_base_mps2_ = attitude.transpose() * specific_force;
  const Eigen::Vector3d before = truth_.velocity_odom_mps;
  truth_.velocity_odom_mps += step_sec * (specific_force - Eigen::Vector3d(0, 0, kGravity_mps2));
  if (crashed_) truth_.velocity_odom_mps.head<2>().setZero();
  truth_.T_odom_base.translation() += 0.5 * step_sec * (before + truth_.velocity_odom_mps);
}

void Quadrotor::standOnGround() {
  double& height_m = truth_.T_odom_base.translation().z();
  if (height_m > rest_height_m_) return;
  height_m = rest_height_m_;
  truth_.velocity_odom_mps.head<2>().setZero();
  truth_.velocity_odom_mps.z() = std::max(0.0, truth_.velocity_odom_mps.z());
  controller_.restart();
  controller_.setTrim(hover_trim_mps2_);
  const double yaw_rad = geometry::yawOf(truth_.T_odom_base.linear());
  truth_.T_odom_base.linear() = geometry::yawRotation(yaw_rad);
  truth_.angular_velocity_base_radps.setZero();
  specific_force_base_mps2_ = Eigen::Vector3d(0, 0, kGravity_mps2);
}

}  // namespace window_ingress::simulation
