#include "window_ingress/geometry/frames.hpp"

#include <cmath>

namespace window_ingress::geometry {

Eigen::Matrix3d R_optical_flu() {
  Eigen::Matrix3d rotation;
  rotation << 0, -1, 0, 0, 0, -1, 1, 0, 0;
  return rotation;
}

Eigen::Isometry3d makePose(const Eigen::Matrix3d& rotation, const Eigen::Vector3d& translation) {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = rotation;
  pose.translation() = translation;
  return pose;
}

Eigen::Matrix3d yawRotation(double yaw_rad) {
  return Eigen::AngleAxisd(yaw_rad, Eigen::Vector3d::UnitZ()).toRotationMatrix();
}

double yawOf(const Eigen::Matrix3d& rotation) { return std::atan2(rotation(1, 0), rotation(0, 0)); }

double wrapAngle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * M_PI);
  return wrapped <= -M_PI ? wrapped + 2.0 * M_PI : wrapped;
}

bool isRotation(const Eigen::Matrix3d& matrix) {
  return matrix.allFinite() && matrix.isUnitary(1e-6) && matrix.determinant() > 0.0;
}

bool isValidPose(const Eigen::Isometry3d& pose) {
  return pose.matrix().allFinite() && isRotation(pose.linear());
}

}  // namespace window_ingress::geometry
