#include "evaluation/poses/pose_chain.hpp"

#include "detection/quads.hpp"
#include "estimation/planar/relative_yaw.hpp"
#include "evaluation/images/detection_survey.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::evaluation {
namespace {

using geometry::Quadrilateral;

estimation::PoseParams paramsFor(const geometry::OpeningSize& opening) {
  estimation::PoseParams params;
  params.opening_width_m = opening.width_m;
  params.opening_height_m = opening.height_m;
  params.max_range_m = 200.0;
  params.max_yaw_rad = 1.55;
  return params;
}

BorderError errorOf(const detection::Edge& edge, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                    const Eigen::Vector2d& true_a, const Eigen::Vector2d& true_b) {
  const Eigen::Vector2d along = (true_b - true_a).normalized(), outwards(along.y(), -along.x());
  const double at_a = outwards.dot(a - true_a), at_b = outwards.dot(b - true_a), length = (b - a).norm();
  BorderError error;
  error.offset_px = 0.5 * (at_a + at_b);
  error.ends_px = 0.5 * (at_b - at_a);
  error.offset_sigmas = error.offset_px / edge.sigma_px;
  error.turn_sigmas = 2.0 * error.ends_px / (length * edge.sigma_rad);
  return error;
}

void compare(const Eigen::Isometry3d& truth, const Eigen::Vector3d& up, PoseChainResult& out) {
  const Eigen::Isometry3d& found = out.estimate->best.T_camera_window;
  out.yaw_error_rad = geometry::yawOf(truth.linear().transpose() * found.linear());
  out.lateral_error_m = found.inverse().translation().y() - truth.inverse().translation().y();
  out.distance_error_m = found.translation().norm() - truth.translation().norm();
  out.true_yaw_rad = estimation::relativeYaw(truth.linear(), up).yaw_rad;
  out.true_yaw_from_sight_rad = estimation::yawFromSight(truth, up);
  out.wrong_sign = out.estimate->yaw_rad * out.true_yaw_rad < 0.0 ||
                   out.estimate->yaw_from_sight_rad * out.true_yaw_from_sight_rad < 0.0;
}

}  // namespace

std::array<std::optional<BorderError>, 4> borderErrors(const detection::WindowObservation& window,
                                                       const Quadrilateral& truth,
                                                       const geometry::PinholeCamera& camera) {
  const Quadrilateral ideal = detection::undistorted(truth, &camera);
  std::array<std::optional<BorderError>, 4> errors;
  for (int i = 0; i < 4; ++i) {
    const detection::Edge& edge = window.edges[i];
    if (!edge.visible || !(edge.sigma_px > 0.0) || !(edge.sigma_rad > 0.0) || edge.a == edge.b) continue;
    errors[i] =
        errorOf(edge, camera.undistort(edge.a), camera.undistort(edge.b), ideal[i], ideal[(i + 1) % 4]);
  }
  return errors;
}

std::optional<Eigen::Isometry3d> poseOfTrueCorners(const Quadrilateral& corners,
                                                   const geometry::PinholeCamera& camera,
                                                   const geometry::OpeningSize& opening) {
  detection::WindowObservation exact;
  exact.corners = corners;
  exact.corner_covariance.fill(1e-4 * Eigen::Matrix2d::Identity());
  estimation::PoseParams params = paramsFor(opening);
  params.systematic_sigma_px = 0.001;
  const auto result = estimation::WindowPoseEstimator(params).estimate(exact, camera);
  if (!result.estimate) return std::nullopt;
  return result.estimate->best.T_camera_window;
}

PoseChainResult chainResult(const SurveyImage& sample,
                            const std::optional<detection::WindowObservation>& window,
                            const estimation::WindowPoseEstimator& estimator,
                            const std::optional<estimation::GravityPrior>& gravity) {
  PoseChainResult out;
  out.scenario = sample.scenario;
  out.seed = sample.seed;
  out.distance_m = sample.distance_m;
  const geometry::OpeningSize opening{estimator.params().opening_width_m,
                                      estimator.params().opening_height_m};
  const auto truth = poseOfTrueCorners(sample.truth.inner, sample.camera, opening);
  if (!truth || !window || !window->whole()) return out;
  out.detected = judge(window->corners, sample.truth) == SurveyVerdict::kHit;
  if (!out.detected) return out;
  out.borders = borderErrors(*window, sample.truth.inner, sample.camera);
  const auto result = estimator.estimate(*window, sample.camera, gravity);
  out.estimate = result.estimate;
  out.reject = result.detail;
  if (out.estimate) compare(*truth, gravity ? gravity->up_camera : Eigen::Vector3d(0.0, -1.0, 0.0), out);
  return out;
}

}  // namespace window_ingress::evaluation
