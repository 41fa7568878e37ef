#include "evaluation/poses/pose_chain.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "estimation/planar/relative_yaw.hpp"
#include "evaluation/csv.hpp"
#include "evaluation/images/detection_survey.hpp"
#include "evaluation/statistics.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/euler_angles.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/text/text.hpp"

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

const char* const kSides[] = {"top", "right", "bottom", "left"};

using Group = std::vector<const PoseChainResult*>;

double medianMagnitude(std::vector<double> values) {
  for (double& value : values) value = std::abs(value);
  return quantile(values, 0.5);
}

std::string poseRow(long distance_m, const Group& group) {
  std::vector<double> yaw, lateral, distance, normalised;
  int detected = 0, trusted = 0, wrong = 0, trusted_wrong = 0;
  for (const PoseChainResult* r : group) {
    detected += r->detected;
    if (!r->estimate) continue;
    yaw.push_back(r->yaw_error_rad * geometry::kDegreesPerRad);
    lateral.push_back(100.0 * r->lateral_error_m);
    distance.push_back(100.0 * r->distance_error_m / r->distance_m);
    normalised.push_back(r->yaw_error_rad / r->estimate->yaw_sigma_rad);
    trusted += r->estimate->sign_trusted;
    wrong += r->wrong_sign;
    trusted_wrong += r->wrong_sign && r->estimate->sign_trusted;
  }
  return formatted("| %ld | %zu | %d | %zu | %.4f | %.4f | %.3f | %.3f | %.2f | %d | %d | %d |\n", distance_m,
                   group.size(), detected, yaw.size(), rms(yaw), medianMagnitude(yaw), rms(lateral),
                   rms(distance), std::pow(rms(normalised), 2), trusted, wrong, trusted_wrong);
}

std::string borderRow(long distance_m, int side, const Group& group) {
  std::vector<double> offset, ends, offset_sigmas, turn_sigmas;
  for (const PoseChainResult* r : group) {
    if (!r->borders[side]) continue;
    offset.push_back(r->borders[side]->offset_px);
    ends.push_back(r->borders[side]->ends_px);
    offset_sigmas.push_back(r->borders[side]->offset_sigmas);
    turn_sigmas.push_back(r->borders[side]->turn_sigmas);
  }
  if (offset.empty()) return "";
  return formatted("| %ld | %s | %zu | %.4f | %+.4f | %.4f | %.4f | %.2f | %.2f | %.2f | %.2f |\n",
                   distance_m, kSides[side], offset.size(), rms(offset), mean(offset),
                   medianMagnitude(offset), rms(ends), std::pow(rms(offset_sigmas), 2),
                   std::pow(medianMagnitude(offset_sigmas) / 0.6745, 2), std::pow(rms(turn_sigmas), 2),
                   std::pow(medianMagnitude(turn_sigmas) / 0.6745, 2));
}

}  // namespace

std::array<std::optional<BorderError>, 4> borderErrors(const detection::WindowObservation& window,
                                                       const Quadrilateral& truth,
                                                       const geometry::PinholeCamera& camera) {
  const Quadrilateral ideal = geometry::undistorted(truth, &camera);
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
  PoseChainResult out{sample};
  const geometry::OpeningSize opening{estimator.params().opening_width_m,
                                      estimator.params().opening_height_m};
  const auto truth = poseOfTrueCorners(sample.truth.inner, sample.camera, opening);
  if (!truth || !window || !window->whole()) return out;
  out.detected = judge(window->corners, sample.truth) == SurveyVerdict::kHit;
  if (!out.detected) return out;
  out.borders = borderErrors(*window, sample.truth.inner, sample.camera);
  const auto result = estimator.estimate(*window, sample.camera, {gravity});
  out.estimate = result.estimate;
  out.reject = result.detail;
  if (out.estimate) compare(*truth, gravity ? gravity->up_camera : Eigen::Vector3d(0.0, -1.0, 0.0), out);
  return out;
}

std::string poseChainColumns() {
  std::string text =
      "scenario,seed,distance_m,true_yaw_rad,true_yaw_from_sight_rad,detected,reject,yaw_error_rad,lateral_"
      "error_m,distance_error_m,yaw_sigma_rad,sigma_u_rad,log_likelihood_ratio,sign_trusted,wrong_sign,"
      "reprojection_rms_px,cost,aspect,aspect_sigma";
  for (const char* side : kSides)
    for (const char* what : {"_offset_px", "_ends_px", "_offset_sigmas", "_turn_sigmas"})
      text += std::string(",") + side + what;
  return text;
}

std::string poseChainRow(const PoseChainResult& r) {
  std::string reject = r.reject;
  std::replace(reject.begin(), reject.end(), ',', ';');
  std::string text = formatted("%s,%u,%.4f,%.6f,%.6f,%d,%s", r.scenario.c_str(), r.seed, r.distance_m,
                               r.true_yaw_rad, r.true_yaw_from_sight_rad, r.detected, reject.c_str());
  if (!r.estimate) {
    text += std::string(12, ',');
  } else {
    const auto& e = *r.estimate;
    text += formatted(",%.7f,%.6f,%.6f,%.7f,%.7f,%.3f,%d,%d,%.4f,%.3f", r.yaw_error_rad, r.lateral_error_m,
                      r.distance_error_m, e.yaw_sigma_rad, e.sigma_u_rad, e.log_likelihood_ratio,
                      e.sign_trusted, r.wrong_sign, e.best.reprojection_rms_px, e.best.cost);
    text += e.aspect ? formatted(",%.5f,%.5f", e.aspect->ratio, e.aspect->sigma) : ",,";
  }
  for (const auto& border : r.borders)
    text += border ? formatted(",%.4f,%.4f,%.3f,%.3f", border->offset_px, border->ends_px,
                               border->offset_sigmas, border->turn_sigmas)
                   : ",,,,";
  return text;
}

std::string poseChainTable(const std::vector<PoseChainResult>& results) {
  std::map<long, Group> groups;
  for (const PoseChainResult& result : results) groups[std::lround(result.distance_m)].push_back(&result);
  std::string text = markdownHead(
      "| m | images | right border | poses | yaw RMSE deg | median deg | lateral RMSE cm | distance RMSE % "
      "| yaw error^2 / variance | sign trusted | wrong | trusted and wrong |");
  for (const auto& [distance_m, group] : groups) text += poseRow(distance_m, group);
  text +=
      "\n" + markdownHead(
                 "| m | side | count | offset RMS px | mean outwards px | median px | ends RMS px | offset "
                 "chi^2 | by median | direction chi^2 | by median |");
  for (const auto& [distance_m, group] : groups)
    for (int side = 0; side < 4; ++side) text += borderRow(distance_m, side, group);
  return text;
}

}  // namespace window_ingress::evaluation
