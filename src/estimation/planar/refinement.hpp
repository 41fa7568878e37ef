#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "estimation/planar/image_measurement.hpp"
#include "window_ingress/estimation/gravity_prior.hpp"
#include "window_ingress/estimation/size_estimate.hpp"
#include "window_ingress/estimation/window_pose_estimate.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::estimation {

/// What a pose is fitted to.
struct RefinementProblem {
  const ImageMeasurement& image;
  const geometry::PinholeCamera& camera;
  geometry::OpeningSize opening;  ///< the size that is known, or believed
  std::optional<GravityPrior> gravity = std::nullopt;
  Eigen::Matrix2d size_root = Eigen::Matrix2d::Zero();  ///< `rootOf` what is believed of it; zero: known
};

/// What is fitted: a pose, and the opening's size in spreads of what is believed of it (unit variance each;
/// without effect where the size is known).
struct FitPoint {
  Eigen::Isometry3d T_camera_window = Eigen::Isometry3d::Identity();
  Eigen::Vector2d size_deviation = Eigen::Vector2d::Zero();
};

geometry::OpeningSize openingAt(const RefinementProblem& problem, const FitPoint& point);

/// Cross product of the window's up with gravity's, weighted; and by rotation about the camera's axes.
struct GravityResidual {
  Eigen::Vector3d residual;
  Eigen::Matrix3d by_rotation;
};
GravityResidual gravityResidual(const GravityPrior& prior, const Eigen::Matrix3d& R_camera_window);

/// Cost of a point with the normal equations at it: six parameters of the pose as in `moved`, two of the
/// size.
struct NormalEquations {
  double cost = 0.0;                  ///< half the sum of squared residuals, gravity included
  double cost_without_gravity = 0.0;  ///< that of the image and the size
  Eigen::Matrix<double, 8, 8> information = Eigen::Matrix<double, 8, 8>::Zero();
  Eigen::Matrix<double, 8, 1> gradient = Eigen::Matrix<double, 8, 1>::Zero();
};

/// Nothing if a corner does not lie in front of the camera.
std::optional<NormalEquations> linearise(const RefinementProblem& problem, const FitPoint& point);

/// The local maximum of the likelihood next to `start`, by Levenberg-Marquardt; covariance by the inverse of
/// the information matrix, the size's part of it marginalised. Nothing if the start is behind the camera or
/// the information is singular.
std::optional<PlanarSolution> refine(const RefinementProblem& problem, const FitPoint& start);

}  // namespace window_ingress::estimation
