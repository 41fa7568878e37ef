#include "estimation/filter/window_hypothesis.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

using geometry::wrapAngle;
using Vector = WindowState::Vector;
using Matrix = WindowState::Matrix;
using Index = WindowState::Index;
using Weight = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 8, 8>;

constexpr int kMaxDescents = 20;
constexpr double kConverged = 1e-5;  // of a step's squared Mahalanobis length
constexpr double kPriorPositionSigmaM = 3.0, kPriorYawSigmaRad = 0.7;
constexpr double kLateSigmaSec = 0.08;   // of odometry's stamps against the images'
constexpr double kStandingSigma = 1e-6;  // [heights/s]: practically zero, yet invertible

template <typename Llt>
double halfLogDeterminant(const Llt& llt) {
  return llt.matrixLLT().diagonal().array().log().sum();
}

/// The posterior's negative logarithm and its normal equations at one state.
struct FitState {
  WindowState state;
  double cost = 0.0;
  Matrix information;
  Vector gradient;
};

/// The maximum a posteriori by Levenberg-Marquardt: belief and image together.
class HypothesisFit {
 public:
  HypothesisFit(const WindowState& prior, const Matrix& prior_information, const FilterView& view)
      : prior_(prior), prior_information_(prior_information), view_(view) {}

  /// Includes the noise of the odometry, by its effect on the corners at the prior.
  bool setNoise(const FilterParams& params, const ImageMeasurement& image) {
    image_ = &image;
    const auto linear = linearise(image, view_.camera, cameraAt(prior_), prior_);
    if (!linear) return false;
    Eigen::Matrix<double, 6, 1> sigma;
    sigma << Eigen::Vector3d::Constant(params.odom_position_sigma_m),
        Eigen::Vector3d::Constant(params.odom_attitude_sigma_rad);
    const ResidualJacobian<6> scaled = linear->by_camera * sigma.asDiagonal();
    Weight both = Weight::Identity(scaled.rows(), scaled.rows());
    both += scaled.lazyProduct(scaled.transpose());
    noise_.compute(both);
    return noise_.info() == Eigen::Success;
  }

  std::optional<FitState> evaluate(const WindowState& at) const {
    const auto linear = linearise(*image_, view_.camera, cameraAt(at), at);
    if (!linear) return std::nullopt;
    Residual r = linear->residual;
    ResidualJacobian<WindowState::kSize> J = linear->by_state;
    noise_.matrixL().solveInPlace(r);
    noise_.matrixL().solveInPlace(J);
    const Vector off = difference(at.values, prior_.values), pull = prior_information_ * off;
    FitState point;
    point.state = at;
    point.cost = 0.5 * (r.squaredNorm() + off.dot(pull));
    point.information = prior_information_;
    point.information += J.transpose().lazyProduct(J);
    point.gradient = pull;
    point.gradient += J.transpose().lazyProduct(r);
    if (!std::isfinite(point.cost) || !point.information.allFinite() || !point.gradient.allFinite())
      return std::nullopt;
    return point;
  }

  FitState descend(FitState best) const {
    double damping = 1e-6;
    for (int iteration = 0; iteration < kMaxDescents && damping < 1e8; ++iteration) {
      Matrix damped = best.information;
      damped.diagonal() *= 1.0 + damping;
      const Vector step = -damped.llt().solve(best.gradient);
      if (!step.allFinite() || step.dot(best.information * step) < kConverged) break;
      WindowState moved = best.state;
      moved.values += step;
      const auto tried = evaluate(moved);
      const bool better = tried && tried->cost < best.cost;
      if (better) best = *tried;
      damping = better ? 0.1 * damping : std::max(10.0 * damping, 1e-3);
    }
    return best;
  }

  const Eigen::LLT<Weight>& noise() const { return noise_; }

 private:
  ScaledCamera cameraAt(const WindowState& state) const {
    const double share =
        prior_.values(WindowState::kInverseHeight) / state.values(WindowState::kInverseHeight);
    Eigen::Isometry3d T = view_.T_odom_camera;
    T.translation() += (share - 1.0) * view_.jitter_m;
    return {T, view_.motion, share * view_.jitter_m};
  }

  const WindowState& prior_;
  const Matrix& prior_information_;
  const FilterView& view_;
  const ImageMeasurement* image_ = nullptr;
  Eigen::LLT<Weight> noise_;
};

// Least cost near an almost optimal point: one more step, in the quadratic model only.
double leastCostNear(const FitState& point) {
  return point.cost - 0.5 * point.gradient.dot(point.information.llt().solve(point.gradient));
}

}  // namespace

WindowHypothesis::WindowHypothesis(const FilterParams& params, const Eigen::Isometry3d& T_odom_window,
                                   const SizeEstimate& size, const YawBias& yaw_bias,
                                   const Eigen::Vector3d& anchor_m) {
  const double inverse_height = 1.0 / size.size.height_m;
  state_.anchor_m = anchor_m;
  state_.values << inverse_height * (T_odom_window.translation() - anchor_m),
      geometry::yawOf(T_odom_window.linear()), 0.0, yaw_bias.rad, 0.0,
      std::log(size.size.width_m / size.size.height_m), inverse_height, 0.0, 0.0, Eigen::Vector3d::Zero();
  const double speed = inverse_height * params.target_speed_mps;
  Vector sigma = Vector::Zero();
  sigma.tail<3>().setConstant(std::max(speed, kStandingSigma));
  sigma.head<7>() << Eigen::Vector3d::Constant(inverse_height * kPriorPositionSigmaM), kPriorYawSigmaRad,
      params.attitude_bias_sigma_rad, yaw_bias.sigma_rad, params.attitude_bias_sigma_rad;
  sigma(WindowState::kHeadingBias) = params.heading_bias_sigma_rad;
  sigma(WindowState::kLate) = kLateSigmaSec;
  covariance_ = sigma.cwiseAbs2().asDiagonal();
  Eigen::Matrix2d aspect_and_scale;
  aspect_and_scale << 1.0, -1.0, 0.0, -inverse_height;
  const Eigen::Matrix2d at_least =
      std::pow(FilterParams::kKnownSizeSigma, 2) * Eigen::Matrix2d::Identity() + size.log_covariance;
  covariance_.block<2, 2>(WindowState::kLogAspect, WindowState::kLogAspect) =
      aspect_and_scale * at_least * aspect_and_scale.transpose();
}

void WindowHypothesis::predict(const FilterParams& params, double elapsed_sec, double way_m,
                               const Eigen::Vector3d& camera_position) {
  move(params.targetMotion(), elapsed_sec);
  const double kept = std::exp(-elapsed_sec / params.attitude_bias_time_sec);
  const double renewed = (1.0 - kept * kept) * std::pow(params.attitude_bias_sigma_rad, 2);
  for (const Index bias : {WindowState::kPitchBias, WindowState::kRollBias}) {
    state_.values(bias) *= kept;
    covariance_.row(bias) *= kept;
    covariance_.col(bias) *= kept;
    covariance_(bias, bias) += renewed;
  }
  const double inverse_height = state_.values(WindowState::kInverseHeight);
  const double drift =
      std::pow(params.drift_m_per_sqrt_sec, 2) * elapsed_sec + std::pow(params.drift_m_per_sqrt_m, 2) * way_m;
  covariance_.topLeftCorner<3, 3>().diagonal().array() += inverse_height * inverse_height * drift;
  addTurn(params.drift_rad_per_sqrt_sec * std::sqrt(elapsed_sec), camera_position);
}

void WindowHypothesis::addTurn(double sigma_rad, const Eigen::Vector3d& camera_position, bool lasts) {
  Vector turn = Vector::Zero();
  turn.head<3>() = state_.values(WindowState::kInverseHeight) *
                   Eigen::Vector3d::UnitZ().cross(state_.position() - camera_position);
  turn(WindowState::kYaw) = 1.0;
  if (lasts) turn(WindowState::kYawBias) = 1.0;
  covariance_ += sigma_rad * sigma_rad * turn * turn.transpose();
}

void WindowHypothesis::move(const MotionModel& motion, double elapsed_sec) {
  if (motion.stands()) return;
  const MotionModel::While passed = motion.over(elapsed_sec);
  Matrix step = Matrix::Identity();
  step.block<3, 3>(WindowState::kX, WindowState::kVelocityX).diagonal().setConstant(passed.way_sec);
  step.block<3, 3>(WindowState::kVelocityX, WindowState::kVelocityX).diagonal().setConstant(passed.kept);
  state_.values = step * Vector(state_.values);
  covariance_ = step * Matrix(covariance_) * step.transpose();
  const double heights = std::pow(state_.values(WindowState::kInverseHeight), 2);
  for (int axis = 0; axis < 3; ++axis) {
    const int place = WindowState::kX + axis, velocity = WindowState::kVelocityX + axis;
    covariance_(place, place) += heights * passed.place_variance;
    covariance_(velocity, velocity) += heights * passed.velocity_variance;
    covariance_(place, velocity) += heights * passed.cross_covariance;
    covariance_(velocity, place) += heights * passed.cross_covariance;
  }
}

std::optional<WindowHypothesis::Outcome> WindowHypothesis::update(const FilterParams& params,
                                                                  const FilterView& view) {
  const Eigen::LLT<Matrix> prior(covariance_);
  if (prior.info() != Eigen::Success) return std::nullopt;
  const Matrix prior_information = prior.solve(Matrix::Identity());
  HypothesisFit fit(state_, prior_information, view);
  if (!fit.setNoise(params, view.image)) return std::nullopt;
  const auto start = fit.evaluate(state_);
  if (!start) return std::nullopt;
  const FitState best = fit.descend(*start);
  const Eigen::LLT<Matrix> posterior(best.information);
  if (posterior.info() != Eigen::Success) return std::nullopt;
  Outcome outcome;
  outcome.log_evidence = -best.cost - halfLogDeterminant(fit.noise()) - halfLogDeterminant(prior) -
                         halfLogDeterminant(posterior);
  if (!fit.setNoise(params, view.alone)) return std::nullopt;
  const auto alone = fit.evaluate(best.state);
  if (!alone) return std::nullopt;
  outcome.squares = 2.0 * leastCostNear(*alone);

  const double scale = state_.values(WindowState::kInverseHeight);
  const double scale_variance = covariance_(WindowState::kInverseHeight, WindowState::kInverseHeight);
  state_ = best.state;
  covariance_ = posterior.solve(Matrix::Identity());
  if (!view.moves) keepScale(scale, scale_variance);
  state_.values(WindowState::kYaw) = wrapAngle(state_.yaw());
  return outcome;
}

// Combines the distribution of the other values given the scale with the previous distribution of the scale.
void WindowHypothesis::keepScale(double inverse_height, double variance) {
  constexpr Index kScale = WindowState::kInverseHeight;
  const double found = covariance_(kScale, kScale);
  const Vector by_scale = covariance_.col(kScale) / found;
  state_.values += by_scale * (inverse_height - state_.values(kScale));
  covariance_ += (variance - found) * by_scale * by_scale.transpose();
}

Eigen::Matrix4d WindowHypothesis::poseCovariance() const {
  const auto slope = state_.poseByValues();
  return slope * covariance_ * slope.transpose();
}

Eigen::Matrix3d WindowHypothesis::velocityCovariance() const {
  const double height_m = state_.heightM();
  return height_m * height_m * covariance_.block<3, 3>(WindowState::kVelocityX, WindowState::kVelocityX);
}

SizeEstimate WindowHypothesis::size() const {
  Eigen::Matrix2d log_size;
  log_size << 1.0, -state_.heightM(), 0.0, -state_.heightM();
  const Eigen::Matrix2d aspect_and_scale =
      covariance_.block<2, 2>(WindowState::kLogAspect, WindowState::kLogAspect);
  return {state_.opening(), log_size * aspect_and_scale * log_size.transpose()};
}

double WindowHypothesis::yawFromSight(const Eigen::Vector3d& camera_position) const {
  const Eigen::Vector3d sight = state_.position() - camera_position;
  return wrapAngle(state_.yaw() - std::atan2(sight.y(), sight.x()));
}

Eigen::RowVector4d WindowHypothesis::yawFromSightByPose(const Eigen::Vector3d& camera_position) const {
  const Eigen::Vector2d sight = (state_.position() - camera_position).head<2>();
  return {sight.y() / sight.squaredNorm(), -sight.x() / sight.squaredNorm(), 0.0, 1.0};
}

double WindowHypothesis::yawFromSightSigma(const Eigen::Vector3d& camera_position) const {
  const auto slope = yawFromSightByPose(camera_position);
  return std::sqrt(slope.dot(poseCovariance() * slope.transpose()));
}

WindowHypothesis WindowHypothesis::mirrored(const Eigen::Vector3d& camera_position) const {
  WindowHypothesis out = *this;
  out.state_.values(WindowState::kYaw) = wrapAngle(state_.yaw() - 2.0 * yawFromSight(camera_position));
  Eigen::RowVector4d yaw_by_pose = -2.0 * yawFromSightByPose(camera_position);
  yaw_by_pose(3) += 1.0;
  Matrix jacobian = Matrix::Identity();
  jacobian.row(WindowState::kYaw) = yaw_by_pose * state_.poseByValues();
  out.covariance_ = jacobian * covariance_ * jacobian.transpose();
  return out;
}

WindowHypothesis WindowHypothesis::mergedWith(const WindowHypothesis& other, double share) const {
  const Vector apart = difference(other.state_.values, state_.values);
  WindowHypothesis out = *this;
  out.state_.values += share * apart;
  out.state_.values(WindowState::kYaw) = wrapAngle(out.state_.yaw());
  out.covariance_ = (1.0 - share) * covariance_ + share * other.covariance_ +
                    share * (1.0 - share) * apart * apart.transpose();
  return out;
}

double WindowHypothesis::distanceTo(const WindowHypothesis& other) const {
  const Eigen::Vector4d apart = difference(state_.values, other.state_.values).head<4>();
  const Eigen::Matrix4d spread = covariance_.topLeftCorner<4, 4>() + other.covariance_.topLeftCorner<4, 4>();
  return apart.dot(spread.ldlt().solve(apart));
}

}  // namespace window_ingress::estimation
