#include "estimation/planar/refinement.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace window_ingress::estimation {
namespace {

using Matrix8d = Eigen::Matrix<double, 8, 8>;
using Vector8d = Eigen::Matrix<double, 8, 1>;

constexpr int kMaxIterations = 60;

FitPoint movedBy(const FitPoint& point, const Vector8d& step) {
  return {moved(point.T_camera_window, step.head<6>()), point.size_deviation + step.tail<2>()};
}

Vector8d dampedStep(const NormalEquations& equations, double damping) {
  Matrix8d damped = equations.information;
  damped.diagonal() *= 1.0 + damping;
  return -damped.ldlt().solve(equations.gradient);
}

// True if the step is shorter than a millionth of the spread that the information allows.
bool hasConverged(const NormalEquations& equations, const Vector8d& step) {
  return step.dot(equations.information * step) < 1e-12 * (1.0 + equations.cost);
}

// The residual is the weighted cross product of the window's and gravity's up.
void addGravity(const GravityPrior& prior, const Eigen::Matrix3d& R_camera_window, NormalEquations& out) {
  const Eigen::Vector3d up = prior.up_camera.normalized(), window_up = R_camera_window.col(2);
  const Eigen::Vector3d residual = window_up.cross(up) / prior.sigma_rad;
  const Eigen::Matrix3d by_rotation = skew(up) * skew(window_up) / prior.sigma_rad;
  out.cost += 0.5 * residual.squaredNorm();
  out.information.block<3, 3>(3, 3) += by_rotation.transpose() * by_rotation;
  out.gradient.segment<3>(3) += by_rotation.transpose() * residual;
}

geometry::OpeningSize openingAt(const RefinementProblem& problem, const FitPoint& point) {
  return scaled(problem.opening, problem.size_root * point.size_deviation);
}

CornerVector throughLens(const geometry::PinholeCamera& camera, CornerVector corners_px) {
  for (int i = 0; i < 4; ++i) corners_px.segment<2>(2 * i) = camera.distort(corners_px.segment<2>(2 * i));
  return corners_px;
}

std::optional<PlanarSolution> solutionAt(const RefinementProblem& problem, const FitPoint& point,
                                         const NormalEquations& equations) {
  const Eigen::LLT<Matrix8d> information(equations.information);
  if (information.info() != Eigen::Success) return std::nullopt;
  const Matrix8d covariance = information.solve(Matrix8d::Identity());
  if (!covariance.allFinite() || !point.T_camera_window.matrix().allFinite()) return std::nullopt;
  PlanarSolution solution;
  solution.T_camera_window = point.T_camera_window;
  solution.covariance = covariance.topLeftCorner<6, 6>();
  solution.opening = openingAt(problem, point);
  solution.opening_log_covariance =
      problem.size_root * covariance.bottomRightCorner<2, 2>() * problem.size_root.transpose();
  const auto predicted = predictOpening(problem.camera, point.T_camera_window, solution.opening);
  const CornerVector off_px = throughLens(problem.camera, predicted->corners_px) -
                              throughLens(problem.camera, problem.image.cornersPx());
  solution.reprojection_rms_px = off_px.norm() / std::sqrt(8.0);
  solution.cost = equations.cost_without_gravity;
  return solution;
}

}  // namespace

std::optional<NormalEquations> linearise(const RefinementProblem& problem, const FitPoint& point) {
  const auto predicted = predictOpening(problem.camera, point.T_camera_window, openingAt(problem, point));
  if (!predicted) return std::nullopt;
  const LinearisedResidual image = problem.image.evaluate(predicted->corners_px);
  Matrix8d by_parameters;
  by_parameters << predicted->by_pose, predicted->by_log_size * problem.size_root;
  const ResidualJacobian<8> jacobian = image.by_corners.lazyProduct(by_parameters);
  NormalEquations equations;
  equations.information = jacobian.transpose().lazyProduct(jacobian);
  equations.gradient = jacobian.transpose().lazyProduct(image.residual);
  equations.information.diagonal().tail<2>().array() += 1.0;
  equations.gradient.tail<2>() += point.size_deviation;
  equations.cost = 0.5 * (image.residual.squaredNorm() + point.size_deviation.squaredNorm());
  equations.cost_without_gravity = equations.cost;
  if (problem.gravity) addGravity(*problem.gravity, point.T_camera_window.linear(), equations);
  if (!equations.information.allFinite() || !equations.gradient.allFinite()) return std::nullopt;
  return equations;
}

std::optional<PlanarSolution> refine(const RefinementProblem& problem, const FitPoint& start) {
  FitPoint point = start;
  auto equations = linearise(problem, point);
  if (!equations) return std::nullopt;
  double damping = 1e-4;
  for (int iteration = 0; iteration < kMaxIterations && damping < 1e12; ++iteration) {
    const Vector8d step = dampedStep(*equations, damping);
    if (!step.allFinite()) return std::nullopt;
    if (hasConverged(*equations, step)) break;
    const FitPoint tried = movedBy(point, step);
    const auto tried_equations = linearise(problem, tried);
    if (tried_equations && tried_equations->cost < equations->cost) {
      point = tried;
      equations = tried_equations;
      damping = std::max(0.1 * damping, 1e-12);
    } else {
      damping *= 10.0;
    }
  }
  return solutionAt(problem, point, *equations);
}

}  // namespace window_ingress::estimation
