/// Valid inputs that tests of the navigator can change.
#pragma once

#include <cmath>

#include "navigation/motion/input_monitor.hpp"
#include "window_ingress/geometry/frames.hpp"
#include "without_glass.hpp"

namespace window_ingress::test {

inline navigation::VehicleState vehicleAt(const Eigen::Vector3d& position_m, double stamp_sec,
                                          double yaw_rad = 0.0) {
  navigation::VehicleState vehicle;
  vehicle.stamp_sec = stamp_sec;
  vehicle.T_odom_base = geometry::makePose(geometry::yawRotation(yaw_rad), position_m);
  return vehicle;
}

/// An open window at the origin of odom, 1.5 m high; its axis is odom's x axis.
inline navigation::TargetEstimate targetAtOrigin(double stamp_sec, bool sign_trusted = true) {
  navigation::TargetEstimate target;
  target.stamp_sec = stamp_sec;
  target.T_odom_window.translation() = Eigen::Vector3d(0, 0, 1.5);
  target.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1e-5;
  target.sign_trusted = sign_trusted;
  target.opening = {1.2, 1.0};
  target.openness.openness = openness::Openness::kOpen;
  return target;
}

/// A step's checked input: the vehicle here, with or without a new estimate of the window.
inline navigation::Situation situationAt(const Eigen::Vector3d& position_m, double now_sec, bool with_target,
                                         double yaw_rad = 0.0) {
  navigation::Situation situation;
  situation.now_sec = now_sec;
  situation.dt_sec = 0.03;
  situation.vehicle = vehicleAt(position_m, now_sec, yaw_rad);
  if (with_target) situation.target = targetAtOrigin(now_sec);
  situation.target_is_new = with_target;
  return situation;
}

inline navigation::NavigatorInput inputAt(const Eigen::Vector3d& position_m, double now_sec,
                                          bool with_target = true) {
  navigation::NavigatorInput input;
  input.vehicle = vehicleAt(position_m, now_sec);
  input.vehicle->T_odom_base.translation().z() += 1e-7 * std::sin(1e3 * now_sec);  // so that no two are equal
  input.image_stamp_sec = now_sec;
  if (with_target) input.target = targetAtOrigin(now_sec);
  return input;
}

}  // namespace window_ingress::test
