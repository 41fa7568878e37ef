#pragma once

#include <optional>

#include "estimation/planar/planar_solutions.hpp"
#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

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
