#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "estimation/planar/refinement.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::estimation {

/// Homography of the window plane (P11, eq. 5-6): s (u, v, 1) = H (X, Y, 1), with (u, v) on the image plane
/// at distance 1, free of K and of distortion, and (X, Y) [m] on the opening: X right, Y down, origin at its
/// centre. Its scale has H(2, 2) > 0 where the centre lies in front of the camera. Nothing if the corners are
/// not finite or determine no homography (three on a line).
std::optional<Eigen::Matrix3d> windowHomography(const geometry::Quadrilateral& corners_normalised,
                                                const geometry::OpeningSize& size);

/// Pose of the window frame (x into the opening, y left, z up) from H = s [r1 r2 t] (P12); t_z > 0 decides
/// the sign of s. r1 and r2 are not orthonormal under noise: projected onto SO(3) by SVD. Nothing if H is
/// singular, not finite or puts the centre into the camera's plane.
std::optional<Eigen::Isometry3d> poseFromHomography(const Eigen::Matrix3d& homography);

/// Start of a fit: the pose from the homography for the prior size (P11, P12). If the prior lets the width
/// vary alone, also the width that makes r1 and r2 equally long, as they are for the true size: |h1| / |h2|
/// is the factor by which the assumed width over height is too small. Nothing without a homography.
std::optional<FitPoint> startFromHomography(const RefinementProblem& problem);

/// Most likely width over height from this image alone, and gravity if known; the pose is fitted as well.
/// Nothing without a homography or where the fit fails.
std::optional<MeasuredAspect> measureAspect(const RefinementProblem& problem);

}  // namespace window_ingress::estimation
