#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <random>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::evaluation {

/// A line fitted to one sample per pixel between two points, each with this noise across; with its spreads.
/// \param offset, turn drawn with unit variance
detection::Edge noisyBorder(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double sample_sigma_px,
                            double offset, double turn);

/// The corner in which two borders meet, and its covariance from their spreads.
void crossBorders(const detection::Edge& before, const detection::Edge& after, Eigen::Vector2d& corner,
                  Eigen::Matrix2d& covariance);

/// Observation of an opening by a line-fitting detector, if each pixel along a border is one sample with
/// independent noise across: the four fitted lines with their spreads, and the corners where they cross.
/// Without distortion. Nothing unless the opening lies in front of the camera.
std::optional<detection::WindowObservation> noisyBorders(const geometry::PinholeCamera& camera,
                                                         const Eigen::Isometry3d& T_camera_window,
                                                         const geometry::OpeningSize& opening,
                                                         double sample_sigma_px, std::mt19937& random);

/// Cramér-Rao bounds: no unbiased estimator has smaller spreads on such borders.
struct PoseBound {
  double yaw_rad = 0.0;      ///< about the window's vertical, the opening's size known
  double lateral_m = 0.0;    ///< of the camera across the window's axis, the opening's size known
  double sigma_u_rad = 0.0;  ///< of the yaw with the opening's size unknown
};

/// Computed from the samples, integrated along the borders; shares only the projection with the estimator.
/// Nothing if the samples do not determine the pose.
std::optional<PoseBound> poseBound(const geometry::PinholeCamera& camera,
                                   const Eigen::Isometry3d& T_camera_window,
                                   const geometry::OpeningSize& opening, double sample_sigma_px);

}  // namespace window_ingress::evaluation
