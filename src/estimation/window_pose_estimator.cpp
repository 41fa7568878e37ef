#include "window_ingress/estimation/window_pose_estimator.hpp"

#include <algorithm>
#include <cmath>

#include "estimation/planar/homography.hpp"
#include "estimation/planar/observation_check.hpp"
#include "estimation/planar/planar_solutions.hpp"
#include "estimation/planar/refinement.hpp"
#include "estimation/planar/relative_yaw.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/parameters/fields.hpp"
#include "window_ingress/text/text.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kCertain = 1e9;
constexpr double kTrustedYawSigmas = 3.0, kTrustedLogLikelihoodRatio = 6.2;  // the latter: one wrong in 500

// Length that, seen head-on at `range_m`, subtends the angle between two points of the image.
double apparentLength(const geometry::PinholeCamera& camera, double range_m, const Eigen::Vector2d& a_px,
                      const Eigen::Vector2d& b_px) {
  const Eigen::Vector3d a = camera.normalised(a_px).homogeneous(), b = camera.normalised(b_px).homogeneous();
  return 2.0 * range_m * std::tan(0.5 * std::atan2(a.cross(b).norm(), a.dot(b)));
}

void describeSides(const RefinementProblem& problem, WindowPoseEstimate& out) {
  const CornerVector& corners = problem.image.cornersPx();
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

// Everything that follows from the solutions of a view: yaw and its spreads, the paper's angles (P12),
// apparent width and height, side lengths (P21), measured aspect, and whether the sign is trusted.
WindowPoseEstimate describe(const RefinementProblem& problem, const PlanarSolutions& solutions,
                            const Eigen::Vector3d& up_camera) {
  WindowPoseEstimate out;
  out.best = solutions.best;
  out.alternative = solutions.alternative;
  const double misfit = misfitOf(out.best);
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
  out.aspect = measureAspect(problem);
  out.euler = geometry::eulerFromRotation(geometry::R_optical_flu().transpose() * T.linear());
  describeSides(problem, out);
  judgeSign(misfit, out);
  return out;
}

constexpr double kSystematicTurn = 0.4;  // part of the systematic error that turns a border

PoseResult rejected(PoseReject reason, std::string detail) {
  return {std::nullopt, reason, std::move(detail)};
}

std::string exceeds(const char* what, double value, const char* relation, double limit, const char* unit) {
  return formatted("%s %.3g %s %s %.3g %s", what, value, unit, relation, limit, unit);
}

// Tests the limits on the pose; returns the first violation.
PoseResult checked(const PoseParams& params, const Eigen::Vector3d& up_camera,
                   const WindowPoseEstimate& estimate) {
  const Eigen::Isometry3d& T = estimate.best.T_camera_window;
  const double range = T.translation().norm();
  const double tilt = std::acos(std::clamp(T.linear().col(2).dot(up_camera), -1.0, 1.0));
  if (!geometry::isValidPose(T) || !std::isfinite(estimate.yaw_sigma_rad + estimate.yaw_rad))
    return rejected(PoseReject::kNotFinite, "the fitted pose or its uncertainty is not finite");
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

// No corner of a whole window may lie behind the camera, because its image would be that of the opposite
// direction.
bool isInFront(const detection::WindowObservation& window, const WindowPoseEstimate& estimate) {
  if (!window.whole()) return true;
  const auto corners = geometry::openingCorners(estimate.opening);
  return std::all_of(corners.begin(), corners.end(), [&](const Eigen::Vector3d& corner) {
    return (estimate.best.T_camera_window * corner).z() > 0.0;
  });
}

ImageNoise noiseOf(const PoseParams& params) {
  ImageNoise noise;
  noise.systematic_sigma_px = params.systematic_sigma_px;
  noise.systematic_turn = kSystematicTurn;
  return noise;
}

PoseHints usable(const PoseHints& given) {
  PoseHints hints = given;
  if (hints.gravity && !isUsable(*hints.gravity)) hints.gravity.reset();
  if (hints.size && !isUsable(*hints.size)) hints.size.reset();
  return hints;
}

}  // namespace

const char* toString(PoseReject reject) {
  constexpr const char* kNames[] = {"none",         "bad_camera", "bad_corners", "not_in_front",
                                    "reprojection", "range",      "tilt",        "not_finite"};
  return kNames[static_cast<std::size_t>(reject)];
}

WindowPoseEstimator::WindowPoseEstimator(const PoseParams& params)
    : params_(parameters::requireInRange(params, "pose parameters")) {}

PoseResult WindowPoseEstimator::estimate(const detection::WindowObservation& window,
                                         const geometry::PinholeCamera& camera,
                                         const PoseHints& given) const {
  const auto camera_faults = camera.validate();
  if (!camera_faults.empty()) return rejected(PoseReject::kBadCamera, parameters::joined(camera_faults));
  if (!std::isfinite(window.stamp_sec)) return rejected(PoseReject::kNotFinite, "the stamp is not finite");
  const PoseHints hints = usable(given);
  const std::string fault = faultOfCorners(window, camera);
  if (!fault.empty()) return rejected(PoseReject::kBadCorners, fault);

  const Eigen::Vector3d up =
      hints.gravity ? hints.gravity->up_camera.normalized() : Eigen::Vector3d(0, -1, 0);
  if (!isUpright(window, up))
    return rejected(PoseReject::kBadCorners, "partial view, rolled by 45 degrees or more");
  const auto ordered = upright(window, up);
  const auto image = ImageMeasurement::make(ordered, camera, noiseOf(params_));
  if (!image) return rejected(PoseReject::kBadCorners, "corners cannot be undistorted");
  const geometry::OpeningSize stated{params_.opening_width_m, params_.opening_height_m};
  const SizeEstimate size =
      hints.size ? *hints.size : sizeEstimate(stated, params_.scale_sigma, params_.aspect_sigma);
  const RefinementProblem problem{*image, camera, size.size, hints.gravity, rootOf(size)};
  const auto solutions = planarSolutions(problem);
  if (!solutions)
    return rejected(PoseReject::kNotInFront, "no pose in front of the camera explains the corners");
  WindowPoseEstimate estimate = describe(problem, *solutions, up);
  const auto stray = withoutStrayBorder(problem, estimate);
  if (stray) estimate = describe(stray->problem, stray->solutions, up);
  estimate.stamp_sec = window.stamp_sec;
  if (stray) estimate.opening = size.size, estimate.opening_log_covariance.setZero();
  if (!isInFront(window, estimate))
    return rejected(PoseReject::kNotInFront, "a corner of the window would lie behind the camera");
  return checked(params_, up, estimate);
}

}  // namespace window_ingress::estimation
