#include "estimation/planar/relative_yaw.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>

namespace window_ingress::estimation {

namespace {
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kWideLogWidth = 10.0;
}  // namespace

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

double yawFromSight(const Eigen::Isometry3d& T_camera_window, const Eigen::Vector3d& up_camera) {
  const Eigen::Vector3d up = up_camera.normalized(), sight = T_camera_window.translation();
  const Eigen::Vector3d axis = T_camera_window.linear().col(0);
  const Eigen::Vector3d ahead = sight - sight.dot(up) * up;
  return std::atan2(axis.dot(up.cross(ahead)), axis.dot(ahead));
}

double yawSigma(const RelativeYaw& yaw, const Matrix6d& covariance) {
  const double variance = yaw.by_rotation.dot(covariance.bottomRightCorner<3, 3>() * yaw.by_rotation);
  return std::isfinite(variance) && variance >= 0.0 ? std::sqrt(variance) : kInfinity;
}

RefinementProblem withFreeWidth(const RefinementProblem& problem) {
  RefinementProblem free = problem;
  free.size_root << kWideLogWidth, 0.0, 0.0, 0.0;
  return free;
}

double yawSigmaOfUnknownSize(const RefinementProblem& problem, const Eigen::Isometry3d& T_camera_window,
                             const RelativeYaw& yaw) {
  RefinementProblem free = withFreeWidth(problem);
  free.gravity.reset();
  const auto equations = linearise(free, {T_camera_window, Eigen::Vector2d::Zero()});
  if (!equations) return kInfinity;
  const Eigen::LLT<Eigen::Matrix<double, 8, 8>> llt(equations->information);
  if (llt.info() != Eigen::Success) return kInfinity;
  Eigen::Matrix<double, 8, 1> gradient = Eigen::Matrix<double, 8, 1>::Zero();
  gradient.segment<3>(3) = yaw.by_rotation;
  const double variance = gradient.dot(llt.solve(gradient));
  return std::isfinite(variance) && variance >= 0.0 ? std::sqrt(variance) : kInfinity;
}

}  // namespace window_ingress::estimation
