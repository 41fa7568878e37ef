#include "window_ingress/pose/window_pose_estimator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/pose/observation_check.hpp"
#include "window_ingress/pose/planar_solutions.hpp"
#include "window_ingress/pose/relative_yaw.hpp"

namespace window_ingress::pose {
namespace {

constexpr double kCertain = 1e9;
// 99 % of fits with the assumed noise leave a smaller sum of squares over their two spare residuals.
constexpr double kExpectedSquares = 9.2;

PoseResult rejected(PoseReject reason, std::string detail) {
  return {std::nullopt, reason, std::move(detail)};
}

std::string exceeds(const char* what, double value, const char* relation, double limit, const char* unit) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, "%s %.3g %s %s %.3g %s", what, value, unit, relation, limit, unit);
  return buffer;
}

// A fit worse than noise allows shows that the noise is larger than was said; spreads are widened
// accordingly.
double misfit(const PlanarSolution& best) { return std::max(1.0, 2.0 * best.cost / kExpectedSquares); }

void widen(PlanarSolutions& solutions) {
  const double factor = misfit(solutions.best);
  solutions.best.covariance *= factor;
  if (solutions.alternative) solutions.alternative->covariance *= factor;
}

// Length that, seen square at the window's range, subtends the angle between the middles of left and right
// border.
double apparentWidth(const RefinementProblem& problem, double range_m) {
  const CornerVector& c = problem.image.cornersPx();
  const auto ray = [&](const Eigen::Vector2d& ideal_px) {
    const auto& camera = problem.camera;
    return Eigen::Vector3d((ideal_px.x() - camera.cx) / camera.fx, (ideal_px.y() - camera.cy) / camera.fy,
                           1.0);
  };
  const Eigen::Vector3d left = ray(0.5 * (c.segment<2>(0) + c.segment<2>(6)));
  const Eigen::Vector3d right = ray(0.5 * (c.segment<2>(2) + c.segment<2>(4)));
  return 2.0 * range_m * std::tan(0.5 * std::atan2(left.cross(right).norm(), left.dot(right)));
}

void describe(const RefinementProblem& problem, const Eigen::Vector3d& up_camera, WindowPoseEstimate& out) {
  const Eigen::Isometry3d& T = out.best.T_camera_window;
  const RelativeYaw yaw = relativeYaw(T.linear(), up_camera);
  out.opening = problem.opening;
  out.yaw_rad = yaw.yaw_rad;
  out.yaw_sigma_rad = yawSigma(yaw, out.best.covariance);
  out.sigma_u_rad = std::min(M_PI, yawSigmaOfUnknownSize(problem, T, yaw) * std::sqrt(misfit(out.best)));
  out.euler = geometry::eulerFromRotation(geometry::R_optical_flu().transpose() * T.linear());
  out.opening_width_m = apparentWidth(problem, T.translation().norm());
  const CornerVector& c = problem.image.cornersPx();
  out.left_side_px = (c.segment<2>(0) - c.segment<2>(6)).norm();
  out.right_side_px = (c.segment<2>(2) - c.segment<2>(4)).norm();
}

void judgeSign(const PoseParams& params, WindowPoseEstimate& out) {
  out.log_likelihood_ratio =
      out.alternative ? std::min(kCertain, (out.alternative->cost - out.best.cost) / misfit(out.best))
                      : kCertain;
  out.sign_trusted = params.trusted_yaw_sigmas * out.sigma_u_rad < std::abs(out.yaw_rad) &&
                     out.log_likelihood_ratio >= params.trusted_log_likelihood_ratio;
}

// Limits on the pose itself; `result` keeps the first that is broken.
PoseResult checked(const PoseParams& params, const Eigen::Vector3d& up_camera,
                   const WindowPoseEstimate& estimate) {
  const Eigen::Isometry3d& T = estimate.best.T_camera_window;
  const double range = T.translation().norm();
  const double tilt = std::acos(std::clamp(T.linear().col(2).dot(up_camera), -1.0, 1.0));
  if (!geometry::isValidPose(T) || !std::isfinite(estimate.yaw_sigma_rad + estimate.yaw_rad))
    return rejected(PoseReject::kNotFinite, "the fit has no finite pose or spread");
  if (T.linear().col(0).dot(T.translation()) <= 0.0)
    return rejected(PoseReject::kNotInFront, "the window would be seen from behind");
  if (estimate.best.reprojection_rms_px > params.max_reprojection_rms_px)
    return rejected(PoseReject::kReprojection, exceeds("reprojection", estimate.best.reprojection_rms_px, ">",
                                                       params.max_reprojection_rms_px, "px"));
  if (range < params.min_range_m)
    return rejected(PoseReject::kRange, exceeds("range", range, "<", params.min_range_m, "m"));
  if (range > params.max_range_m)
    return rejected(PoseReject::kRange, exceeds("range", range, ">", params.max_range_m, "m"));
  if (tilt > params.max_tilt_rad)
    return rejected(PoseReject::kTilt, exceeds("tilt", tilt, ">", params.max_tilt_rad, "rad"));
  if (std::abs(estimate.yaw_rad) > params.max_yaw_rad)
    return rejected(PoseReject::kTilt,
                    exceeds("yaw", std::abs(estimate.yaw_rad), ">", params.max_yaw_rad, "rad"));
  return {estimate, PoseReject::kNone, ""};
}

}  // namespace

const char* toString(PoseReject reject) {
  switch (reject) {
    case PoseReject::kNone:
      return "none";
    case PoseReject::kBadCamera:
      return "bad_camera";
    case PoseReject::kBadCorners:
      return "bad_corners";
    case PoseReject::kNotInFront:
      return "not_in_front";
    case PoseReject::kReprojection:
      return "reprojection";
    case PoseReject::kRange:
      return "range";
    case PoseReject::kTilt:
      return "tilt";
    case PoseReject::kNotFinite:
      return "not_finite";
  }
  return "unknown";
}

WindowPoseEstimator::WindowPoseEstimator(const PoseParams& params) : params_(params) {
  auto faults = parameters::outOfRange(params);
  if (params.min_range_m >= params.max_range_m) faults.push_back("min_range_m is not below max_range_m");
  if (!faults.empty()) throw std::invalid_argument("pose parameters: " + parameters::joined(faults));
}

PoseResult WindowPoseEstimator::estimate(const detection::WindowObservation& window,
                                         const geometry::PinholeCamera& camera,
                                         const std::optional<GravityPrior>& gravity) const {
  const auto camera_faults = camera.validate();
  if (!camera_faults.empty()) return rejected(PoseReject::kBadCamera, parameters::joined(camera_faults));
  if (!std::isfinite(window.stamp_sec)) return rejected(PoseReject::kNotFinite, "the stamp is not finite");
  const std::string fault = faultOfCorners(window, camera, params_);
  if (!fault.empty()) return rejected(PoseReject::kBadCorners, fault);

  const bool has_gravity = gravity && isUsable(*gravity);
  const Eigen::Vector3d up = has_gravity ? gravity->up_camera.normalized() : Eigen::Vector3d(0, -1, 0);
  const auto ordered = upright(window, up);
  const auto image = ImageMeasurement::make(
      ordered, camera, {params_.systematic_sigma_px, params_.unknown_corner_sigma_px, 1.0});
  if (!image) return rejected(PoseReject::kBadCorners, "corners cannot be undistorted");
  const RefinementProblem problem{*image,
                                  camera,
                                  {params_.opening_width_m, params_.opening_height_m},
                                  has_gravity ? gravity : std::nullopt};
  auto solutions = planarSolutions(problem);
  if (!solutions)
    return rejected(PoseReject::kNotInFront, "no pose in front of the camera explains the corners");
  WindowPoseEstimate estimate;
  widen(*solutions);
  estimate.stamp_sec = window.stamp_sec;
  estimate.best = solutions->best;
  estimate.alternative = solutions->alternative;
  describe(problem, up, estimate);
  judgeSign(params_, estimate);
  return checked(params_, up, estimate);
}

}  // namespace window_ingress::pose
