#include "window_ingress/pose/window_hypothesis.hpp"

#include <Eigen/Dense>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::pose {
namespace {

using geometry::wrapAngle;
using State = WindowHypothesis::State;

constexpr int kMaxIterations = 20;
constexpr double kPriorPositionSigmaM = 3.0;

Eigen::Isometry3d windowPose(const State& state) {
  return geometry::makePose(geometry::yawRotation(state(WindowHypothesis::kYaw)), state.head<3>());
}

Eigen::Isometry3d windowInCamera(const State& state, const Eigen::Isometry3d& T_odom_camera) {
  const Eigen::Vector3d bias(state(WindowHypothesis::kPitchBias), 0.0, state(WindowHypothesis::kRollBias));
  Eigen::Isometry3d attitude_error = Eigen::Isometry3d::Identity();
  if (bias.norm() > 0.0) attitude_error.linear() = Eigen::AngleAxisd(bias.norm(), bias.normalized()).matrix();
  return attitude_error * T_odom_camera.inverse() * windowPose(state);
}

// How the pose in the camera moves when the whole world turns about the camera's axes.
Eigen::Matrix<double, 6, 3> byCameraTurn(const Eigen::Isometry3d& T_camera_window) {
  Eigen::Matrix<double, 6, 3> turn;
  turn << -skew(T_camera_window.translation()), Eigen::Matrix3d::Identity();
  return turn;
}

Matrix6d byState(const Eigen::Isometry3d& T_camera_window, const Eigen::Matrix3d& R_camera_odom) {
  Matrix6d jacobian = Matrix6d::Zero();
  jacobian.topLeftCorner<3, 3>() = R_camera_odom;
  jacobian.block<3, 1>(3, WindowHypothesis::kYaw) = R_camera_odom.col(2);
  const auto turn = byCameraTurn(T_camera_window);
  jacobian.col(WindowHypothesis::kPitchBias) = turn.col(0);
  jacobian.col(WindowHypothesis::kRollBias) = turn.col(2);
  return jacobian;
}

using Weight = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

struct Linearised {
  Residual residual;
  ResidualJacobian<6> by_state;
  ResidualJacobian<6> by_camera;  // by errors of the camera's position and attitude
};

std::optional<Linearised> linearise(const FilterView& view, const State& state) {
  const Eigen::Isometry3d T = windowInCamera(state, view.T_odom_camera);
  const auto predicted = predictOpening(view.camera, T, view.opening);
  if (!predicted) return std::nullopt;
  const LinearisedResidual image = view.image.evaluate(predicted->corners_px);
  const ResidualJacobian<6> by_pose = image.by_corners.lazyProduct(predicted->by_pose);
  Matrix6d by_camera = Matrix6d::Zero();
  by_camera.topLeftCorner<3, 3>().setIdentity();
  by_camera.rightCols<3>() = byCameraTurn(T);
  return Linearised{image.residual, by_pose * byState(T, view.T_odom_camera.linear().transpose()),
                    by_pose * by_camera};
}

State difference(const State& a, const State& b) {
  State out = a - b;
  out(WindowHypothesis::kYaw) = wrapAngle(out(WindowHypothesis::kYaw));
  return out;
}

double halfLogDeterminant(const Eigen::LLT<Weight>& llt) {
  return llt.matrixLLT().diagonal().array().log().sum();
}
double halfLogDeterminant(const Eigen::LLT<Matrix6d>& llt) {
  return llt.matrixLLT().diagonal().array().log().sum();
}

}  // namespace

// The maximum a posteriori by Levenberg-Marquardt: prior and image together.
struct HypothesisFit {
  const WindowHypothesis& prior;
  const FilterView& view;
  Matrix6d prior_information;
  Eigen::LLT<Weight> noise;  // of the weighted residuals: their own and the odometry's
  State state;
  double cost = 0.0;
  Matrix6d information;
  State gradient;

  bool evaluate(const State& at) {
    const auto linear = linearise(view, at);
    if (!linear) return false;
    const Residual r = noise.matrixL().solve(linear->residual);
    const ResidualJacobian<6> J = noise.matrixL().solve(linear->by_state);
    const State off = difference(at, prior.state_);
    cost = 0.5 * (r.squaredNorm() + off.dot(prior_information * off));
    information = prior_information + J.transpose().lazyProduct(J);
    gradient = prior_information * off + J.transpose() * r;
    state = at;
    return std::isfinite(cost) && information.allFinite() && gradient.allFinite();
  }

  void setNoise(const FilterParams& params, const ResidualJacobian<6>& by_camera) {
    Eigen::Matrix<double, 6, 1> variance;
    variance << Eigen::Vector3d::Constant(std::pow(params.odom_position_sigma_m, 2)),
        Eigen::Vector3d::Constant(std::pow(params.odom_attitude_sigma_rad, 2));
    const Weight own = Weight::Identity(by_camera.rows(), by_camera.rows());
    const Weight both = own + by_camera * variance.asDiagonal() * by_camera.transpose();
    noise.compute(both);
  }

  void descend() {
    double damping = 1e-6;
    for (int iteration = 0; iteration < kMaxIterations && damping < 1e8; ++iteration) {
      Matrix6d damped = information;
      damped.diagonal() *= 1.0 + damping;
      const State step = -damped.ldlt().solve(gradient);
      if (!step.allFinite() || step.dot(information * step) < 1e-8) return;
      HypothesisFit tried = *this;
      if (tried.evaluate(state + step) && tried.cost < cost) {
        adopt(tried);
        damping *= 0.1;
      } else {
        damping = std::max(10.0 * damping, 1e-3);
      }
    }
  }

  void adopt(const HypothesisFit& other) {
    state = other.state;
    cost = other.cost;
    information = other.information;
    gradient = other.gradient;
  }
};

WindowHypothesis::WindowHypothesis(const FilterParams& params, const Eigen::Isometry3d& T_odom_window,
                                   double yaw_sigma_rad) {
  state_ << T_odom_window.translation(), geometry::yawOf(T_odom_window.linear()), 0.0, 0.0;
  State sigma;
  sigma << Eigen::Vector3d::Constant(kPriorPositionSigmaM), yaw_sigma_rad,
      Eigen::Vector2d::Constant(params.attitude_bias_sigma_rad);
  covariance_ = sigma.cwiseAbs2().asDiagonal();
}

void WindowHypothesis::predict(const FilterParams& params, double elapsed_sec,
                               const Eigen::Vector3d& camera_from, const Eigen::Vector3d& camera_to) {
  const double kept = std::exp(-elapsed_sec / params.attitude_bias_time_sec);
  State factors;
  factors << 1, 1, 1, 1, kept, kept;
  state_ = factors.asDiagonal() * state_;
  covariance_ = factors.asDiagonal() * covariance_ * factors.asDiagonal();
  const double renewed = (1.0 - kept * kept) * std::pow(params.attitude_bias_sigma_rad, 2);
  covariance_.bottomRightCorner<2, 2>().diagonal().array() += renewed;

  const double drift = std::pow(params.drift_m_per_sqrt_sec, 2) * elapsed_sec +
                       std::pow(params.drift_m_per_sqrt_m, 2) * (camera_to - camera_from).norm();
  covariance_.topLeftCorner<3, 3>().diagonal().array() += drift;
  // Odometry's heading drifts about the vehicle: it carries the window around.
  State turn = State::Zero();
  turn.head<3>() = Eigen::Vector3d::UnitZ().cross(state_.head<3>() - camera_to);
  turn(kYaw) = 1.0;
  covariance_ += std::pow(params.drift_rad_per_sqrt_sec, 2) * elapsed_sec * turn * turn.transpose();
}

std::optional<WindowHypothesis::Outcome> WindowHypothesis::update(const FilterParams& params,
                                                                  const FilterView& view) {
  const Eigen::LLT<Matrix6d> prior(covariance_);
  const auto linear = linearise(view, state_);
  if (prior.info() != Eigen::Success || !linear) return std::nullopt;
  HypothesisFit fit{*this, view, prior.solve(Matrix6d::Identity()), {}, {}, 0.0, {}, {}};
  fit.setNoise(params, linear->by_camera);
  if (fit.noise.info() != Eigen::Success || !fit.evaluate(state_)) return std::nullopt;
  fit.descend();
  const Eigen::LLT<Matrix6d> posterior(fit.information);
  if (posterior.info() != Eigen::Success) return std::nullopt;
  const Outcome outcome{2.0 * fit.cost, -fit.cost - halfLogDeterminant(fit.noise) -
                                            halfLogDeterminant(prior) - halfLogDeterminant(posterior)};
  state_ = fit.state;
  state_(kYaw) = wrapAngle(state_(kYaw));
  covariance_ = posterior.solve(Matrix6d::Identity());
  return outcome;
}

Eigen::Isometry3d WindowHypothesis::T_odom_window() const { return windowPose(state_); }

Eigen::Isometry3d WindowHypothesis::T_camera_window(const Eigen::Isometry3d& T_odom_camera) const {
  return windowInCamera(state_, T_odom_camera);
}

double WindowHypothesis::yawFromSight(const Eigen::Vector3d& camera_position) const {
  const Eigen::Vector3d sight = state_.head<3>() - camera_position;
  return wrapAngle(state_(kYaw) - std::atan2(sight.y(), sight.x()));
}

WindowHypothesis WindowHypothesis::mirrored(const Eigen::Vector3d& camera_position) const {
  const Eigen::Vector2d sight = (state_.head<3>() - camera_position).head<2>();
  WindowHypothesis out = *this;
  out.state_(kYaw) = wrapAngle(state_(kYaw) - 2.0 * yawFromSight(camera_position));
  Matrix6d jacobian = Matrix6d::Identity();
  jacobian(kYaw, kYaw) = -1.0;
  jacobian.block<1, 2>(kYaw, kX) << -2.0 * sight.y() / sight.squaredNorm(),
      2.0 * sight.x() / sight.squaredNorm();
  out.covariance_ = jacobian * covariance_ * jacobian.transpose();
  return out;
}

WindowHypothesis WindowHypothesis::mergedWith(const WindowHypothesis& other, double share) const {
  const State apart = difference(other.state_, state_);
  WindowHypothesis out = *this;
  out.state_ += share * apart;
  out.state_(kYaw) = wrapAngle(out.state_(kYaw));
  out.covariance_ = (1.0 - share) * covariance_ + share * other.covariance_ +
                    share * (1.0 - share) * apart * apart.transpose();
  return out;
}

double WindowHypothesis::distanceTo(const WindowHypothesis& other) const {
  const Eigen::Vector4d apart = difference(state_, other.state_).head<4>();
  const Eigen::Matrix4d spread = covariance_.topLeftCorner<4, 4>() + other.covariance_.topLeftCorner<4, 4>();
  return apart.dot(spread.ldlt().solve(apart));
}

}  // namespace window_ingress::pose
