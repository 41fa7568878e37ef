#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/poses/noisy_borders.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// Our method, and other methods on the four corners of a window of known size.
enum PoseMethod {
  kOurs,
  kOursWithAttitude,
  kIterative,  ///< SOLVEPNP_ITERATIVE: least squares of the corners
  kIppe,       ///< SOLVEPNP_IPPE: the better of its two closed-form poses
  kHomography  ///< the homography decomposed into r1, r2, t (the paper's way)
};
constexpr int kFirstPeer = kIterative, kPoseMethods = kHomography + 1;
const char* nameOfMethod(int method);

/// `T_camera_window` by one of the other methods; nothing if it fails or gives numbers that are not finite.
/// OpenCV's plane has x right, y down and z away from the viewer, because with z towards the camera IPPE
/// fails for a rotation by exactly half a turn.
/// \param corners canonical order, distorted
std::optional<Eigen::Isometry3d> poseByPeer(int method, const geometry::Quadrilateral& corners,
                                            const geometry::PinholeCamera& camera,
                                            const geometry::OpeningSize& opening);

/// Settings common to all draws of a survey. f = 554 px at 640 x 480 pixels, an opening of 1 m by 1 m: the
/// setup of published bounds.
struct PoseSurveySetup {
  geometry::PinholeCamera camera =
      geometry::PinholeCamera::fromFieldOfView(640, 480, 2.0 * std::atan(320.0 / 554.0));
  geometry::OpeningSize opening{1.0, 1.0};
  double attitude_sigma_rad = 0.02;  ///< of the attitude given to one of the methods
  double largest_bearing_rad = 0.2;  ///< of the window against the camera's axis, to either side
  double largest_tilt_rad = 0.1;     ///< of the camera, in pitch and in roll
};

struct PoseCell {
  double distance_m = 0.0;
  double yaw_rad = 0.0;          ///< magnitude, against the line of sight
  double sample_sigma_px = 0.0;  ///< noise of each pixel along a border
};

/// Errors of one method in one cell.
struct MethodErrors {
  int count = 0, failed = 0, wrong_signs = 0;
  double yaw_squares = 0.0, lateral_squares = 0.0;
  double yawRms() const { return std::sqrt(yaw_squares / std::max(1, count)); }          ///< [rad]
  double lateralRms() const { return std::sqrt(lateral_squares / std::max(1, count)); }  ///< [m]
};

struct PoseCellResult {
  PoseCell cell;
  int draws = 0;
  double yaw_bound_rad = 0.0, lateral_bound_m = 0.0, sigma_u_rad = 0.0;  ///< rms over the draws
  std::array<MethodErrors, kPoseMethods> methods;
  int trusted = 0, trusted_wrong = 0;
  double trusted_yaw_squares = 0.0;  ///< our method, draws with a trusted sign
  /// Our method, better one of both solutions: mean squared error over stated variance, 1 if consistent.
  double yaw_consistency = 0.0;

  bool signIsDecidable() const { return sigma_u_rad < cell.yaw_rad / 3.0; }
};

/// Random views of one cell: window to either side and turned either way, camera tilted. Same seed, same
/// draws.
PoseCellResult surveyCell(const PoseSurveySetup& setup, const PoseCell& cell, int draws, std::uint32_t seed);

std::string poseSurveyColumns();
std::string poseSurveyRow(const PoseCellResult& result);  ///< without line end
/// For people: the result of each cell, and each method's yaw error over the bound.
std::string poseSurveyTable(const std::vector<PoseCellResult>& results);
std::string poseSurveySummary(const std::vector<PoseCellResult>& results);

}  // namespace window_ingress::evaluation
