#include "estimation/planar/planar_solutions.hpp"

#include <utility>

#include "estimation/planar/opening_aspect.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kSameRotationRad = 1e-3;

bool areSame(const PlanarSolution& a, const PlanarSolution& b) {
  const Eigen::Quaterniond qa(a.T_camera_window.linear()), qb(b.T_camera_window.linear());
  return qa.angularDistance(qb) < kSameRotationRad;
}

std::optional<FitPoint> startOf(const RefinementProblem& problem) {
  if (problem.image.hasCorners()) return startFromHomography(problem);
  if (!problem.prior) return std::nullopt;
  return FitPoint{problem.prior->T_camera_window, Eigen::Vector2d::Zero()};
}

}  // namespace

Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T_camera_window) {
  const Eigen::Vector3d sight = T_camera_window.translation().normalized();
  const Eigen::Matrix3d reflection = Eigen::Matrix3d::Identity() - 2.0 * sight * sight.transpose();
  Eigen::Matrix3d R = reflection * T_camera_window.linear();
  R.col(0) = -R.col(0);
  return geometry::makePose(R, T_camera_window.translation());
}

std::optional<PlanarSolutions> planarSolutions(const RefinementProblem& problem) {
  const auto start = startOf(problem);
  if (!start) return std::nullopt;
  const auto mirroredStart = [&](const Eigen::Isometry3d& T) {
    return FitPoint{mirrored(T), start->size_deviation};
  };
  auto first = refine(problem, *start);
  if (!first) first = refine(problem, mirroredStart(start->T_camera_window));
  if (!first) return std::nullopt;
  auto second = refine(problem, mirroredStart(first->T_camera_window));
  if (second && areSame(*first, *second)) second.reset();
  if (second && second->cost < first->cost) std::swap(*first, *second);
  return PlanarSolutions{*first, second};
}

}  // namespace window_ingress::estimation
