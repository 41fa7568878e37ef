#pragma once

#include <Eigen/Core>

#include "estimation/planar/planar_solutions.hpp"
#include "estimation/planar/refinement.hpp"
#include "window_ingress/estimation/window_pose_estimate.hpp"

namespace window_ingress::estimation {

/// Everything about a view that follows from its solutions: yaw and its spreads, the paper's angles (P12),
/// apparent width and height, side lengths (P21), measured aspect, and whether the sign is to be trusted.
WindowPoseEstimate describe(const RefinementProblem& problem, const PlanarSolutions& solutions,
                            const Eigen::Vector3d& up_camera);

}  // namespace window_ingress::estimation
