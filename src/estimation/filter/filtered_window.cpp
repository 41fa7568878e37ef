#include "estimation/filter/filtered_window.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace window_ingress::estimation {
namespace {

CameraTurn cameraTurn(const WindowHypothesis& window) {
  constexpr auto kYaw = WindowState::kYawBias, kHeading = WindowState::kHeadingBias;
  const auto& values = window.state().values;
  const auto& covariance = window.covariance();
  const double together =
      covariance(kYaw, kYaw) + covariance(kHeading, kHeading) - 2.0 * covariance(kYaw, kHeading);
  return {-values.segment<3>(WindowState::kPitchBias),
          covariance.block<3, 3>(WindowState::kPitchBias, WindowState::kPitchBias),
          values(kHeading) - values(kYaw), std::sqrt(std::max(0.0, together))};
}

Matrix6d covarianceOf(const WindowHypothesis& window, const FilterParams& params) {
  const Eigen::Matrix4d pose = window.poseCovariance();
  Matrix6d covariance = Matrix6d::Zero();
  covariance.topLeftCorner<3, 3>() = pose.topLeftCorner<3, 3>();
  covariance.topRightCorner<3, 1>() = pose.topRightCorner<3, 1>();
  covariance.bottomLeftCorner<1, 3>() = pose.bottomLeftCorner<1, 3>();
  covariance(3, 3) = covariance(4, 4) = std::pow(params.attitude_bias_sigma_rad, 2);
  covariance(5, 5) = pose(3, 3);
  return covariance;
}

TargetMotion motionOf(const WindowHypothesis& window, const MotionModel& model) {
  if (model.stands()) return {};
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> spread(window.velocityCovariance(),
                                                              Eigen::EigenvaluesOnly);
  return {model, window.state().velocity(), std::sqrt(std::max(0.0, spread.eigenvalues().maxCoeff()))};
}

WindowHypothesis reported(const MirrorHypotheses& beliefs) {
  const auto& hypotheses = beliefs.hypotheses();
  if (hypotheses.size() < 2 || !beliefs.areUnambiguous()) return hypotheses.front().window;
  return hypotheses[0].window.mergedWith(hypotheses[1].window, std::exp(hypotheses[1].log_weight));
}

}  // namespace

FilteredWindow filteredWindow(const MirrorHypotheses& beliefs, const FilterParams& params,
                              const Eigen::Vector3d& camera_position, double unlearned_yaw_rad,
                              double age_sec) {
  const auto predicted = [&](WindowHypothesis window) {
    window.predict(params, std::max(age_sec, 0.0), 0.0, camera_position);
    window.addTurn(unlearned_yaw_rad, camera_position);
    return window;
  };
  const auto& hypotheses = beliefs.hypotheses();
  const WindowHypothesis window = predicted(reported(beliefs));
  FilteredWindow out;
  out.age_sec = age_sec;
  out.T_odom_window = window.T_odom_window();
  out.covariance = covarianceOf(window, params);
  out.hypothesis_weight = std::exp(hypotheses.front().log_weight);
  out.sign_trusted =
      beliefs.areUnambiguous() && window.yawFromSightSigma(camera_position) < params.trusted_yaw_sigma_rad;
  if (hypotheses.size() > 1) {
    const WindowHypothesis other = predicted(hypotheses[1].window);
    out.alternative =
        FilteredWindow::Alternative{other.T_odom_window(), covarianceOf(other, params), cameraTurn(other)};
  }
  out.size = window.size();
  out.camera_turn = cameraTurn(window);
  out.motion = motionOf(window, params.targetMotion());
  return out;
}

}  // namespace window_ingress::estimation
