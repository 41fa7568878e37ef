#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/pose/gravity_prior.hpp"
#include "window_ingress/pose/image_measurement.hpp"
#include "window_ingress/pose/window_pose_estimate.hpp"

namespace window_ingress::pose {

/// What a pose is fitted to.
struct RefinementProblem {
  const ImageMeasurement& image;
  const geometry::PinholeCamera& camera;
  geometry::OpeningSize opening;
  std::optional<GravityPrior> gravity;
};

/// Cost of a pose with the normal equations at it; 6 parameters as in `moved`.
struct NormalEquations {
  double cost = 0.0;        ///< half the sum of squared residuals, gravity included
  double image_cost = 0.0;  ///< without gravity
  Matrix6d information = Matrix6d::Zero();
  Eigen::Matrix<double, 6, 1> gradient = Eigen::Matrix<double, 6, 1>::Zero();
};

/// Nothing if a corner does not lie in front of the camera.
std::optional<NormalEquations> linearise(const RefinementProblem& problem,
                                         const Eigen::Isometry3d& T_camera_window);

/// The local maximum of the likelihood next to `start`, by Levenberg-Marquardt; covariance by the inverse of
/// the information matrix. Nothing if the start is behind the camera or the information is singular.
std::optional<PlanarSolution> refine(const RefinementProblem& problem, const Eigen::Isometry3d& start);

/// Cross product of the window's up with gravity's, weighted; and by rotation about the camera's axes.
struct GravityResidual {
  Eigen::Vector3d residual;
  Eigen::Matrix3d by_rotation;
};
GravityResidual gravityResidual(const GravityPrior& prior, const Eigen::Matrix3d& R_camera_window);

}  // namespace window_ingress::pose
