#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace window_ingress::geometry {

inline constexpr double kDegreesPerRad = 180.0 / M_PI, kRadPerDegree = M_PI / 180.0;

/// Euler angles [rad]: roll about x, pitch about y, yaw about z of a forward-left-up frame. The paper calls
/// them theta, phi and psi.
///
/// The paper's matrix product (its eq. 8) contradicts its own angle formulas. They belong to
/// `R = Rz(yaw) * Ry(pitch) * Rx(roll)`, which is used here.
struct EulerAngles {
  double roll_rad = 0.0;
  double pitch_rad = 0.0;
  double yaw_rad = 0.0;
};

/// roll = atan2(r32, r33), pitch = atan2(-r31, sqrt(r32^2 + r33^2)), yaw = atan2(r21, r11).
/// pitch lies in [-pi/2, pi/2]; at its ends roll and yaw are not unique: roll is then 0.
EulerAngles eulerFromRotation(const Eigen::Matrix3d& rotation);

/// Rz(yaw) * Ry(pitch) * Rx(roll).
Eigen::Matrix3d rotationFromEuler(const EulerAngles& angles);

/// The relative yaw for people, in degrees: "yaw +12.3 +-0.4 deg", followed by "sign unknown" if the sign is
/// not trusted. The spread is limited to a half turn.
std::string yawText(double yaw_rad, double sigma_rad, bool sign_trusted);

}  // namespace window_ingress::geometry
