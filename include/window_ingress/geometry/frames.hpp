/// Frames of the package and how transforms between them are named.
///
/// `T_a_b` is the pose of frame b in frame a: `p_a = T_a_b * p_b`. Rotations are named `R_a_b`.
///
/// | frame    | axes                                                            | source  |
/// |----------|-----------------------------------------------------------------|---------|
/// | odom     | x east, y north, z up; continuous, drifts                       | REP 105 |
/// | base     | x forward, y left, z up; the vehicle (`base_link`)              | REP 103 |
/// | camera   | x right, y down, z forward (`camera_optical_frame`)             | REP 103 |
/// | window   | origin: centre of the opening's front plane; x *into* the opening along the direction of
/// |          | flight, y left, z up: a vehicle square in front of it has zero relative roll, pitch, yaw |
///
/// SI units and radians throughout.
#pragma once

#include <Eigen/Geometry>

#include "window_ingress/geometry/finite_math.hpp"

namespace window_ingress::geometry {

/// Rotation of a forward-left-up body frame in the optical frame of a camera looking along its x axis.
/// A camera square in front of a window has exactly `R_camera_window == R_optical_flu()`.
Eigen::Matrix3d R_optical_flu();

/// Pose from a rotation and a translation.
Eigen::Isometry3d makePose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation);

/// Rotation about z, the vertical axis of odom, base and window [rad].
Eigen::Matrix3d yawRotation(double yaw_rad);

/// Heading of the x axis of a forward-left-up frame, about the z axis of its parent, in (-pi, pi] [rad].
double yawOf(const Eigen::Matrix3d& rotation);

/// The same angle in (-pi, pi] [rad].
double wrapAngle(double angle_rad);

/// True if every number is finite, and the matrix orthonormal to 1e-6 and no reflection.
bool isRotation(const Eigen::Matrix3d& matrix);
/// True if every number of the pose is finite and its rotation is valid.
bool isValidPose(const Eigen::Isometry3d& pose);

}  // namespace window_ingress::geometry
