#pragma once

#include <Eigen/Core>
#include <optional>

#include "estimation/planar/refinement.hpp"

namespace window_ingress::estimation {

/// Width over height of the opening, relative to that of the size the homography was made with. Of
/// H = s [r1 r2 t], r1 and r2 have one length for the true size, so |h1| / |h2| is by what the assumed ratio
/// is too small.
double aspectCorrection(const Eigen::Matrix3d& homography);

/// Where a fit starts: the pose by the homography of the believed size (P11, P12), and, where the belief lets
/// the width move alone, the width that makes r1 and r2 equally long. Nothing without a homography.
std::optional<FitPoint> startFromHomography(const RefinementProblem& problem);

/// Width over height from this image alone (gravity helps if it is known): the likeliest, with the pose
/// fitted beside it. Nothing without a homography or where the fit fails.
std::optional<MeasuredAspect> measureAspect(const RefinementProblem& problem);

}  // namespace window_ingress::estimation
