#include "window_ingress/pose/relative_yaw.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace window_ingress::pose {

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
}

RelativeYaw relativeYaw(const Eigen::Matrix3d& R_camera_window, const Eigen::Vector3d& up_camera) {
  const Eigen::Vector3d up = up_camera.normalized(), view = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d forward = (view - view.dot(up) * up).normalized(), left = up.cross(forward);
  const Eigen::Vector3d axis = R_camera_window.col(0);
  const double ahead = axis.dot(forward), aside = axis.dot(left);
  const double horizontal = ahead * ahead + aside * aside;
  RelativeYaw yaw;
  yaw.yaw_rad = std::atan2(aside, ahead);
  if (horizontal > 1e-12) yaw.by_rotation = axis.cross(ahead * left - aside * forward) / horizontal;
  return yaw;
}

double yawSigma(const RelativeYaw& yaw, const Matrix6d& covariance) {
  const double variance = yaw.by_rotation.dot(covariance.bottomRightCorner<3, 3>() * yaw.by_rotation);
  return std::isfinite(variance) && variance >= 0.0 ? std::sqrt(variance) : kInfinity;
}

double yawSigmaOfUnknownSize(const RefinementProblem& problem, const Eigen::Isometry3d& T_camera_window,
                             const RelativeYaw& yaw) {
  const auto predicted = predictOpening(problem.camera, T_camera_window, problem.opening);
  if (!predicted) return kInfinity;
  Eigen::Matrix<double, 8, 7> by_parameters;
  by_parameters << predicted->by_pose, predicted->by_log_size.col(0);
  const ResidualJacobian<7> jacobian =
      problem.image.evaluate(predicted->corners_px).by_corners * by_parameters;
  const Eigen::Matrix<double, 7, 7> information = jacobian.transpose() * jacobian;
  const Eigen::LLT<Eigen::Matrix<double, 7, 7>> llt(information);
  if (llt.info() != Eigen::Success) return kInfinity;
  Eigen::Matrix<double, 7, 1> gradient = Eigen::Matrix<double, 7, 1>::Zero();
  gradient.segment<3>(3) = yaw.by_rotation;
  const double variance = gradient.dot(llt.solve(gradient));
  return std::isfinite(variance) && variance >= 0.0 ? std::sqrt(variance) : kInfinity;
}

}  // namespace window_ingress::pose
