#pragma once

#include "estimation/planar/planar_solutions.hpp"
#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

/// A fit worse than the stated noise allows (99 %) shows that the noise is larger than was said: by what the
/// variances grow, 1 within that limit, the mean squared spare residual far beyond it.
double misfitOf(const RefinementProblem& problem, const PlanarSolution& best);

/// All variances of the solution times `factor`.
void widen(double factor, PlanarSolution& solution);

}  // namespace window_ingress::estimation
