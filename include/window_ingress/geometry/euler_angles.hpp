#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>

namespace window_ingress::geometry {

inline constexpr double kDegreesPerRad = 180.0 / M_PI;

/// Euler angles of the paper [rad]: theta about x, phi about y, psi about z.
///
/// The paper's matrix product (its eq. 8) does not fit its own angle formulas; the formulas are those of
/// `R = Rz(psi) * Ry(phi) * Rx(theta)`, which is what stands here. For a forward-left-up frame they are roll,
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

/// The relative yaw for people, in degrees: "yaw +12.3 +-0.4 deg", with "sign unknown" after it where it is.
/// Spreads beyond a half turn say no more than that; they are cut there.
std::string yawText(double yaw_rad, double sigma_rad, bool sign_trusted);

}  // namespace window_ingress::geometry
