#include "window_ingress/pose/planar_solutions.hpp"

#include <utility>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/pose/homography.hpp"

namespace window_ingress::pose {
namespace {

constexpr double kSameRotationRad = 1e-3;

geometry::Quadrilateral normalisedCorners(const RefinementProblem& problem) {
  geometry::Quadrilateral corners;
  const auto& camera = problem.camera;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d pixel = problem.image.cornersPx().segment<2>(2 * i);
    corners[i] = {(pixel.x() - camera.cx) / camera.fx, (pixel.y() - camera.cy) / camera.fy};
  }
  return corners;
}

bool areSame(const PlanarSolution& a, const PlanarSolution& b) {
  const Eigen::Quaterniond qa(a.T_camera_window.linear()), qb(b.T_camera_window.linear());
  return qa.angularDistance(qb) < kSameRotationRad;
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
  const auto homography = windowHomography(normalisedCorners(problem), problem.opening);
  if (!homography) return std::nullopt;
  const auto start = poseFromHomography(*homography);
  if (!start) return std::nullopt;
  auto first = refine(problem, *start);
  if (!first) first = refine(problem, mirrored(*start));
  if (!first) return std::nullopt;
  auto second = refine(problem, mirrored(first->T_camera_window));
  if (second && areSame(*first, *second)) second.reset();
  if (second && second->cost < first->cost) std::swap(*first, *second);
  return PlanarSolutions{*first, second};
}

}  // namespace window_ingress::pose
