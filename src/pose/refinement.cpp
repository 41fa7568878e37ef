#include "window_ingress/pose/refinement.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace window_ingress::pose {
namespace {

constexpr int kMaxIterations = 60;

double reprojectionRms(const RefinementProblem& problem, const CornerVector& predicted_px) {
  return (predicted_px - problem.image.cornersPx()).norm() / std::sqrt(8.0);
}

Eigen::Matrix<double, 6, 1> dampedStep(const NormalEquations& equations, double damping) {
  Matrix6d damped = equations.information;
  damped.diagonal() *= 1.0 + damping;
  return -damped.ldlt().solve(equations.gradient);
}

// Step and decrease below which nothing is left to gain: a millionth of the spread that the information
// allows.
bool hasConverged(const NormalEquations& equations, const Eigen::Matrix<double, 6, 1>& step) {
  return step.dot(equations.information * step) < 1e-12 * (1.0 + equations.cost);
}

}  // namespace

GravityResidual gravityResidual(const GravityPrior& prior, const Eigen::Matrix3d& R_camera_window) {
  const Eigen::Vector3d up = prior.up_camera.normalized(), window_up = R_camera_window.col(2);
  return {window_up.cross(up) / prior.sigma_rad, skew(up) * skew(window_up) / prior.sigma_rad};
}

std::optional<NormalEquations> linearise(const RefinementProblem& problem,
                                         const Eigen::Isometry3d& T_camera_window) {
  const auto predicted = predictOpening(problem.camera, T_camera_window, problem.opening);
  if (!predicted) return std::nullopt;
  const LinearisedResidual image = problem.image.evaluate(predicted->corners_px);
  const ResidualJacobian<6> by_pose = image.by_corners.lazyProduct(predicted->by_pose);
  NormalEquations equations;
  equations.image_cost = equations.cost = 0.5 * image.residual.squaredNorm();
  equations.information = by_pose.transpose().lazyProduct(by_pose);
  equations.gradient = by_pose.transpose().lazyProduct(image.residual);
  if (problem.gravity) {
    const GravityResidual gravity = gravityResidual(*problem.gravity, T_camera_window.linear());
    equations.cost += 0.5 * gravity.residual.squaredNorm();
    equations.information.bottomRightCorner<3, 3>() += gravity.by_rotation.transpose() * gravity.by_rotation;
    equations.gradient.tail<3>() += gravity.by_rotation.transpose() * gravity.residual;
  }
  if (!equations.information.allFinite() || !equations.gradient.allFinite()) return std::nullopt;
  return equations;
}

std::optional<PlanarSolution> refine(const RefinementProblem& problem, const Eigen::Isometry3d& start) {
  Eigen::Isometry3d pose = start;
  auto equations = linearise(problem, pose);
  if (!equations) return std::nullopt;
  double damping = 1e-4;
  for (int iteration = 0; iteration < kMaxIterations && damping < 1e12; ++iteration) {
    const Eigen::Matrix<double, 6, 1> step = dampedStep(*equations, damping);
    if (!step.allFinite()) return std::nullopt;
    if (hasConverged(*equations, step)) break;
    const Eigen::Isometry3d tried = moved(pose, step);
    const auto tried_equations = linearise(problem, tried);
    if (tried_equations && tried_equations->cost < equations->cost) {
      pose = tried;
      equations = tried_equations;
      damping = std::max(0.1 * damping, 1e-12);
    } else {
      damping *= 10.0;
    }
  }
  const Eigen::LLT<Matrix6d> information(equations->information);
  if (information.info() != Eigen::Success) return std::nullopt;
  PlanarSolution solution;
  solution.T_camera_window = pose;
  solution.covariance = information.solve(Matrix6d::Identity());
  solution.reprojection_rms_px =
      reprojectionRms(problem, predictOpening(problem.camera, pose, problem.opening)->corners_px);
  solution.cost = equations->image_cost;
  if (!solution.covariance.allFinite() || !pose.matrix().allFinite()) return std::nullopt;
  return solution;
}

}  // namespace window_ingress::pose
