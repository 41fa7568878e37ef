#pragma once

#include <Eigen/Geometry>
#include <optional>

#include "window_ingress/geometry/opening.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::evaluation {

/// What others make of the four corners of a window of known size. OpenCV's plane has x right, y down and z
/// away from the viewer: with z towards the camera IPPE fails where the rotation is by exactly half a turn.
enum class PeerMethod {
  kIterative,  ///< SOLVEPNP_ITERATIVE: least squares of the corners
  kIppe,       ///< SOLVEPNP_IPPE: the better of its two closed-form poses
  kHomography  ///< the homography decomposed into r1, r2, t (the paper's way)
};
constexpr int kPeerMethods = 3;
const char* toString(PeerMethod method);

/// `T_camera_window`; nothing where the method fails or gives numbers that are not finite.
/// \param corners canonical order, distorted
std::optional<Eigen::Isometry3d> poseByPeer(PeerMethod method, const geometry::Quadrilateral& corners,
                                            const geometry::PinholeCamera& camera,
                                            const geometry::OpeningSize& opening);

}  // namespace window_ingress::evaluation
