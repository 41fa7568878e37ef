#include "window_ingress/geometry/euler_angles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "window_ingress/text/text.hpp"

namespace window_ingress::geometry {

EulerAngles eulerFromRotation(const Eigen::Matrix3d& rotation) {
  const double cos_pitch = std::hypot(rotation(2, 1), rotation(2, 2));
  const double pitch_rad = std::atan2(-rotation(2, 0), cos_pitch);
  if (cos_pitch < 1e-9) return {0.0, pitch_rad, std::atan2(-rotation(0, 1), rotation(1, 1))};
  return {std::atan2(rotation(2, 1), rotation(2, 2)), pitch_rad, std::atan2(rotation(1, 0), rotation(0, 0))};
}

Eigen::Matrix3d rotationFromEuler(const EulerAngles& angles) {
  using Eigen::AngleAxisd;
  using Eigen::Vector3d;
  return (AngleAxisd(angles.yaw_rad, Vector3d::UnitZ()) * AngleAxisd(angles.pitch_rad, Vector3d::UnitY()) *
          AngleAxisd(angles.roll_rad, Vector3d::UnitX()))
      .toRotationMatrix();
}

std::string yawText(double yaw_rad, double sigma_rad, bool sign_trusted) {
  if (!std::isfinite(yaw_rad) || !std::isfinite(sigma_rad)) return "yaw not finite";
  const double sigma_deg = std::clamp(sigma_rad * kDegreesPerRad, 0.0, 180.0);
  return formatted(sigma_deg < 0.095 ? "yaw %+.2f +-%.2f deg%s" : "yaw %+.1f +-%.1f deg%s",
                   yaw_rad * kDegreesPerRad, sigma_deg, sign_trusted ? "" : ", sign unknown");
}

}  // namespace window_ingress::geometry
