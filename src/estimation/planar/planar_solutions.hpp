#pragma once

#include <optional>

#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

/// Factor for the variances. A fit worse than the stated noise allows (99 %) shows that the noise is larger
/// than stated. The factor is 1 within that limit, and the mean squared spare residual far beyond it.
double misfitOf(const PlanarSolution& best);

/// Multiplies all variances of the solution by `factor`.
void widen(double factor, PlanarSolution& solution);

/// The poses that explain the image of a planar rectangle: the likelier one first.
struct PlanarSolutions {
  PlanarSolution best;
  std::optional<PlanarSolution> alternative;  ///< nothing if both minima coincide
};

/// The pose with the window's orientation mirrored about the line of sight to its centre. Its orthographic
/// image is the same, so the other optimum of the likelihood lies near it.
Eigen::Isometry3d mirrored(const Eigen::Isometry3d& T_camera_window);

/// Both maximum-likelihood poses, started at the homography and at its mirror image. The image alone decides
/// which is likelier. Nothing without a homography or where no fit succeeds.
std::optional<PlanarSolutions> planarSolutions(const RefinementProblem& problem);

/// A solution without the place of one border.
struct StrayBorder {
  RefinementProblem problem;  ///< the problem, with width or height free within a few percent
  PlanarSolutions solutions;
};

/// An edge beside a border (the far edge of a reveal, a joint) may be mistaken for it. It has the right
/// direction at the wrong place, so the opening seems narrower or lower than it is. If the opening of known
/// size explains the image worse than noise allows, and one a few percent narrower (or lower) far better, the
/// yaw follows from keystone and the distance from the other pair of borders. Nothing where all borders
/// agree, where the size is unknown, or in a partial view.
/// \param all result of `describe` for the solutions that use all borders
std::optional<StrayBorder> withoutStrayBorder(const RefinementProblem& problem,
                                              const WindowPoseEstimate& all);

}  // namespace window_ingress::estimation
