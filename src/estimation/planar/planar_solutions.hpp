#pragma once

#include <optional>

#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

/// A fit worse than the stated noise allows (99 %) shows that the noise is larger than was said: by what the
/// variances grow, 1 within that limit, the mean squared spare residual far beyond it.
double misfitOf(const PlanarSolution& best);

/// All variances of the solution times `factor`.
void widen(double factor, PlanarSolution& solution);

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

/// A solution that leaves the place of one border out.
struct StrayBorder {
  RefinementProblem problem;  ///< the same, with the width or the height free within a few percent
  PlanarSolutions solutions;
};

/// A border taken for an edge beside it (the far edge of a reveal, a joint) runs in the right direction at
/// the wrong place: the opening seems narrower or lower than it is. Where an opening of known size explains
/// the image worse than noise allows, and one a few percent narrower (or lower) far better, the yaw follows
/// from keystone and the distance from the other pair of borders. Nothing where all borders agree, where the
/// size is not known, or in a partial view.
/// \param all what `describe` says of the solutions that use all borders
std::optional<StrayBorder> withoutStrayBorder(const RefinementProblem& problem,
                                              const WindowPoseEstimate& all);

}  // namespace window_ingress::estimation
