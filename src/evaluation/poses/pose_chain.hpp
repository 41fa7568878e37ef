#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/images/survey_image.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::evaluation {

/// Error of one measured border, in undistorted pixels: the true line relative to the measured one.
struct BorderError {
  double offset_px = 0.0;  ///< at the middle of the measured stretch, positive outwards
  double ends_px = 0.0;    ///< effect of the difference in direction at its ends
  /// Both over the spreads that the detector states; their mean squares are 1 if it is consistent.
  double offset_sigmas = 0.0, turn_sigmas = 0.0;
};

/// Errors of each visible border with stated spreads; nothing for the others.
std::array<std::optional<BorderError>, 4> borderErrors(const detection::WindowObservation& window,
                                                       const geometry::Quadrilateral& truth,
                                                       const geometry::PinholeCamera& camera);

/// The pose at which the opening's corners appear exactly there; nothing if there is none.
std::optional<Eigen::Isometry3d> poseOfTrueCorners(const geometry::Quadrilateral& corners,
                                                   const geometry::PinholeCamera& camera,
                                                   const geometry::OpeningSize& opening);

/// One image, from its pixels to the pose, against the truth.
struct PoseChainResult : SurveySubject {
  double true_yaw_rad = 0.0, true_yaw_from_sight_rad = 0.0;
  bool detected = false;  ///< the right border was detected; otherwise nothing below is set
  std::array<std::optional<BorderError>, 4> borders = {};
  std::string reject = {};  ///< why the detection gives no pose
  std::optional<estimation::WindowPoseEstimate> estimate = {};
  double yaw_error_rad = 0.0, lateral_error_m = 0.0, distance_error_m = 0.0;
  bool wrong_sign = false;  ///< of the yaw, or of the yaw against the line of sight
};

/// \param gravity empty: the attitude is not given
PoseChainResult chainResult(const SurveyImage& sample,
                            const std::optional<detection::WindowObservation>& window,
                            const estimation::WindowPoseEstimator& estimator,
                            const std::optional<estimation::GravityPrior>& gravity);

std::string poseChainColumns();
std::string poseChainRow(const PoseChainResult& result);  ///< without line end

/// Images grouped by their distance, rounded to a metre. For people: errors of the pose, then of the borders.
std::string poseChainTable(const std::vector<PoseChainResult>& results);

}  // namespace window_ingress::evaluation
