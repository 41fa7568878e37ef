#include "window_ingress/estimation/pose_prior.hpp"

#include <Eigen/Cholesky>

#include "estimation/planar/predicted_opening.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

// Derivative of the rotation vector of a rotation by a turn about fixed axes before it (inverse of the left
// Jacobian of SO(3)).
Eigen::Matrix3d vectorByTurn(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  const Eigen::Matrix3d cross = skew(vector), identity = Eigen::Matrix3d::Identity();
  if (angle < 1e-4) return identity - 0.5 * cross + cross * cross / 12.0;
  const double half = 0.5 * angle;
  return identity - 0.5 * cross + (1.0 - half / std::tan(half)) / (angle * angle) * cross * cross;
}

}  // namespace

GravityResidual gravityResidual(const GravityPrior& prior, const Eigen::Matrix3d& R_camera_window) {
  const Eigen::Vector3d up = prior.up_camera.normalized(), window_up = R_camera_window.col(2);
  return {window_up.cross(up) / prior.sigma_rad, skew(up) * skew(window_up) / prior.sigma_rad};
}

bool isUsable(const PosePrior& prior) {
  if (!geometry::isValidPose(prior.T_camera_window) || !prior.covariance.allFinite()) return false;
  const Eigen::LLT<Matrix6d> llt(prior.covariance);
  return llt.info() == Eigen::Success && llt.matrixLLT().diagonal().minCoeff() > 1e-12;
}

PriorResidual priorResidual(const PosePrior& prior, const Eigen::Isometry3d& T_camera_window) {
  const Eigen::AngleAxisd turn(
      Eigen::Matrix3d(T_camera_window.linear() * prior.T_camera_window.linear().transpose()));
  const Eigen::Vector3d vector = turn.angle() * turn.axis();
  Eigen::Matrix<double, 6, 1> deviation;
  deviation << T_camera_window.translation() - prior.T_camera_window.translation(), vector;
  Matrix6d by_pose = Matrix6d::Identity();
  by_pose.bottomRightCorner<3, 3>() = vectorByTurn(vector);
  const Eigen::LLT<Matrix6d> llt(prior.covariance);
  return {llt.matrixL().solve(deviation), llt.matrixL().solve(by_pose)};
}

}  // namespace window_ingress::estimation
