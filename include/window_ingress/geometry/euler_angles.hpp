#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace window_ingress::geometry {

inline constexpr double kDegreesPerRad = 180.0 / M_PI;

/// Euler angles of the paper [rad]: theta about x, phi about y, psi about z.
///
/// The paper's matrix product (its eq. 8) contradicts its own angle formulas. They belong to
/// `R = Rz(psi) * Ry(phi) * Rx(theta)`, which is used here. For a forward-left-up frame the angles are roll,
/// pitch and yaw.
struct EulerAngles {
  double theta_rad = 0.0;
  double phi_rad = 0.0;
  double psi_rad = 0.0;
};

/// theta = atan2(r32, r33), phi = atan2(-r31, sqrt(r32^2 + r33^2)), psi = atan2(r21, r11).
/// phi lies in [-pi/2, pi/2]; at its ends theta and psi are not unique: theta is then 0.
EulerAngles eulerFromRotation(const Eigen::Matrix3d& rotation);

/// Rz(psi) * Ry(phi) * Rx(theta).
Eigen::Matrix3d rotationFromEuler(const EulerAngles& angles);

/// The relative yaw for people, in degrees: "yaw +12.3 +-0.4 deg", followed by "sign unknown" if the sign is
/// not trusted. The spread is limited to a half turn.
std::string yawText(double yaw_rad, double sigma_rad, bool sign_trusted);

}  // namespace window_ingress::geometry
