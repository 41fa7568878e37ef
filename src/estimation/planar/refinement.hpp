#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "estimation/planar/image_measurement.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// Data and priors of a pose fit.
struct RefinementProblem {
  const ImageMeasurement& image;
  const geometry::PinholeCamera& camera;
  geometry::OpeningSize opening;  ///< known size, or mean of its prior
  std::optional<GravityPrior> gravity = std::nullopt;
  Eigen::Matrix2d size_root = Eigen::Matrix2d::Zero();  ///< `rootOf` the size's prior; zero: known
};

/// Fitted values: a pose, and the opening's size in standard deviations of its prior (unit variance each; no
/// effect where the size is known).
struct FitPoint {
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();
  Eigen::Vector2d size_deviation = Eigen::Vector2d::Zero();
};

/// Cost of a point with the normal equations at it: six parameters of the pose as in `moved`, two of the
/// size.
struct NormalEquations {
  double cost = 0.0;                  ///< half the sum of squared residuals, gravity included
  double cost_without_gravity = 0.0;  ///< of image and size only
  Eigen::Matrix<double, 8, 8> information = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> gradient = Eigen::Matrix<double, 8, 1>::Zero();
};

/// Nothing if a corner does not lie in front of the camera.
std::optional<NormalEquations> linearise(const RefinementProblem& problem, const FitPoint& point);

/// The local maximum of the likelihood near `start`, by Levenberg-Marquardt. The covariance is the inverse of
/// the information matrix, with the size marginalised. Nothing if the start is behind the camera or the
/// information is singular.
std::optional<PlanarSolution> refine(const RefinementProblem& problem, const FitPoint& start);

}  // namespace window_ingress::estimation
