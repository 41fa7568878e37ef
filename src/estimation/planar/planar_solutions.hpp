#pragma once

#include <optional>

#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

/// The poses that explain the image of a planar rectangle: the likelier one first.
struct PlanarSolutions {
  PlanarSolution best;
  std::optional<PlanarSolution> alternative;  ///< nothing where both minima are one
};

/// The pose with the window's orientation mirrored about the line of sight to its centre: its orthographic
/// image is the same, so the other minimum of the likelihood lies next to it.
Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T_camera_window);

/// Both maximum-likelihood poses, started at the homography and at its mirror image. The image alone says
/// which is the likelier. Nothing without a homography or where no fit succeeds.
std::optional<PlanarSolutions> planarSolutions(const RefinementProblem& problem);

}  // namespace window_ingress::estimation
