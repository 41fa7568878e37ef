#include "simulation/camera/camera_truth.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::simulation {
namespace {

constexpr double kMinDepth_m = 0.5;

}  // namespace

CameraTruth CameraTruth::of(const VehicleTruth& truth, const Eigen::Isometry3d& T_odom_window,
                            const Eigen::Isometry3d& T_base_camera) {
  CameraTruth motion;
  motion.T_window_camera = T_odom_window.inverse() * truth.T_odom_base * T_base_camera;
  const Eigen::Vector3d& turn = truth.angular_velocity_base_radps;
  const Eigen::Vector3d lever = truth.T_odom_base.linear() * turn.cross(T_base_camera.translation());
  motion.velocity_window_mps = T_odom_window.linear().transpose() * (truth.velocity_odom_mps + lever);
  motion.angular_velocity_camera_radps = T_base_camera.linear().transpose() * turn;
  return motion;
}

CameraTruth CameraTruth::turned(const Eigen::Matrix3d& R_turned_camera) const {
  CameraTruth motion = *this;
  motion.T_window_camera.rotate(R_turned_camera.transpose());
  motion.angular_velocity_camera_radps = R_turned_camera * angular_velocity_camera_radps;
  return motion;
}

Eigen::Isometry3d CameraTruth::T_camera_window(double after_sec) const {
  Eigen::Isometry3d pose = T_window_camera;
  pose.translation() += after_sec * velocity_window_mps;
  const Eigen::Vector3d turn = after_sec * angular_velocity_camera_radps;
  if (turn.norm() > 0.0) pose.rotate(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
  return pose.inverse();
}

double CameraTruth::greatestShift(const geometry::PinholeCamera& camera, double duration_sec) const {
  const double depth_m = std::max(kMinDepth_m, std::abs(T_window_camera.translation().x()));
  const Eigen::Vector3d velocity = T_window_camera.linear().transpose() * velocity_window_mps / depth_m;
  const Eigen::Vector3d& turn = angular_velocity_camera_radps;
  double greatest_px = 0.0;
  for (const double u : {0.0, camera.width - 1.0})
    for (const double v : {0.0, camera.height - 1.0}) {
      const double x = (u - camera.cx) / camera.fx, y = (v - camera.cy) / camera.fy;
      const Eigen::Vector3d ray(x, y, 1.0);
      const Eigen::Vector3d moved = -(velocity + turn.cross(ray));
      const Eigen::Vector2d shift(camera.fx * (moved.x() - x * moved.z()),
                                  camera.fy * (moved.y() - y * moved.z()));
      greatest_px = std::max(greatest_px, shift.norm());
    }
  return duration_sec * greatest_px;
}

}  // namespace window_ingress::simulation
