#include "estimation/planar/planar_solutions.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "estimation/planar/homography.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kSpare = 2.0;          // of the eight residuals, beyond the six of the pose
constexpr double kChiSquared99 = 9.21;  // 99 % quantile of chi-squared with kSpare degrees of freedom
constexpr double kSameRotationRad = 1e-3;

bool areSame(const PlanarSolution& a, const PlanarSolution& b) {
  const Eigen::Quaterniond qa(a.T_camera_window.linear()), qb(b.T_camera_window.linear());
  return qa.angularDistance(qb) < kSameRotationRad;
}

constexpr double kStraySigma = 0.03;       // of a side's length
constexpr double kMinStrayEvidence = 7.5;  // for a stray border [nats]

// Needs more evidence where keystone alone gives a far less certain yaw, because an apparent stray border is
// then more likely keystone's own noise.
double neededEvidence(const WindowPoseEstimate& all) {
  return kMinStrayEvidence + 2.0 * std::log(std::max(1.0, all.sigma_u_rad / all.yaw_sigma_rad));
}

}  // namespace

double misfitOf(const PlanarSolution& best) {
  return 1.0 + std::max(0.0, 2.0 * best.cost - kChiSquared99) / kSpare;
}

void widen(double factor, PlanarSolution& solution) {
  solution.covariance *= factor;
  solution.opening_log_covariance *= factor;
}

Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T_camera_window) {
  const Eigen::Vector3d sight = T_camera_window.translation().normalized();
  const Eigen::Matrix3d reflection = Eigen::Matrix3d::Identity() - 2.0 * sight * sight.transpose();
  Eigen::Matrix3d R = reflection * T_camera_window.linear();
  R.col(0) = -R.col(0);
  return geometry::makePose(R, T_camera_window.translation());
}

std::optional<PlanarSolutions> planarSolutions(const RefinementProblem& problem) {
  if (!problem.image.hasCorners()) return std::nullopt;
  const auto start = startFromHomography(problem);
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

std::optional<StrayBorder> withoutStrayBorder(const RefinementProblem& problem,
                                              const WindowPoseEstimate& all) {
  if (!problem.size_root.isZero(0.0) || !all.aspect || misfitOf(all.best) <= 1.0) return std::nullopt;
  const bool is_narrow = all.aspect->ratio < problem.opening.width_m / problem.opening.height_m;
  RefinementProblem freed = problem;
  freed.size_root =
      Eigen::Vector2d(is_narrow ? kStraySigma : 0.0, is_narrow ? 0.0 : kStraySigma).asDiagonal();
  const auto solutions = planarSolutions(freed);
  if (!solutions || solutions->best.cost + neededEvidence(all) > all.best.cost) return std::nullopt;
  return StrayBorder{freed, *solutions};
}

}  // namespace window_ingress::estimation
