#include "estimation/planar/view_description.hpp"

#include <algorithm>
#include <cmath>

#include "estimation/planar/covariance_scale.hpp"
#include "estimation/planar/opening_aspect.hpp"
#include "estimation/planar/relative_yaw.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kCertain = 1e9;
constexpr double kTrustedYawSigmas = 3.0, kTrustedLogLikelihoodRatio = 6.2;  // the latter: one wrong in 500

Eigen::Vector3d rayOf(const geometry::PinholeCamera& camera, const Eigen::Vector2d& ideal_px) {
  return {(ideal_px.x() - camera.cx) / camera.fx, (ideal_px.y() - camera.cy) / camera.fy, 1.0};
}

// Length that, seen square at `range_m`, subtends the angle between two points of the image.
double apparentLength(const geometry::PinholeCamera& camera, double range_m, const Eigen::Vector2d& a_px,
                      const Eigen::Vector2d& b_px) {
  const Eigen::Vector3d a = rayOf(camera, a_px), b = rayOf(camera, b_px);
  return 2.0 * range_m * std::tan(0.5 * std::atan2(a.cross(b).norm(), a.dot(b)));
}

CornerVector cornersOf(const RefinementProblem& problem, const PlanarSolution& best) {
  if (problem.image.hasCorners()) return problem.image.cornersPx();
  return predictOpening(problem.camera, best.T_camera_window, best.opening)->corners_px;
}

void describeSides(const RefinementProblem& problem, WindowPoseEstimate& out) {
  const CornerVector corners = cornersOf(problem, out.best);
  const Eigen::Vector2d top_left = corners.segment<2>(0), top_right = corners.segment<2>(2),
                        bottom_right = corners.segment<2>(4), bottom_left = corners.segment<2>(6);
  const double range = out.best.T_camera_window.translation().norm();
  const auto between = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return apparentLength(problem.camera, range, a, b);
  };
  out.opening_width_m = between(0.5 * (top_left + bottom_left), 0.5 * (top_right + bottom_right));
  out.opening_height_m = between(0.5 * (top_left + top_right), 0.5 * (bottom_left + bottom_right));
  out.left_side_px = (top_left - bottom_left).norm();
  out.right_side_px = (top_right - bottom_right).norm();
}

void judgeSign(double misfit, WindowPoseEstimate& out) {
  out.log_likelihood_ratio =
      out.alternative ? std::min(kCertain, (out.alternative->cost - out.best.cost) / misfit) : kCertain;
  const double smaller = std::min(std::abs(out.yaw_rad), std::abs(out.yaw_from_sight_rad));
  out.sign_trusted =
      kTrustedYawSigmas * out.sigma_u_rad < smaller && out.log_likelihood_ratio >= kTrustedLogLikelihoodRatio;
}

}  // namespace

WindowPoseEstimate describe(const RefinementProblem& problem, const PlanarSolutions& solutions,
                            const Eigen::Vector3d& up_camera) {
  WindowPoseEstimate out;
  out.best = solutions.best;
  out.alternative = solutions.alternative;
  const double misfit = misfitOf(problem, out.best);
  widen(misfit, out.best);
  if (out.alternative) widen(misfit, *out.alternative);
  out.opening = out.best.opening;
  out.opening_log_covariance = out.best.opening_log_covariance;

  const Eigen::Isometry3d& T = out.best.T_camera_window;
  const RelativeYaw yaw = relativeYaw(T.linear(), up_camera);
  out.yaw_rad = yaw.yaw_rad;
  out.yaw_sigma_rad = yawSigma(yaw, out.best.covariance);
  out.yaw_from_sight_rad = yawFromSight(T, up_camera);
  RefinementProblem fitted = problem;
  fitted.opening = out.opening;
  out.sigma_u_rad = std::min(M_PI, yawSigmaOfUnknownSize(fitted, T, yaw) * std::sqrt(misfit));
  if (problem.image.hasCorners()) out.aspect = measureAspect(problem);
  out.euler = geometry::eulerFromRotation(geometry::R_optical_flu().transpose() * T.linear());
  describeSides(problem, out);
  judgeSign(misfit, out);
  return out;
}

}  // namespace window_ingress::estimation
