#pragma once

#include <tf2_ros/buffer.h>

#include <Eigen/Geometry>
#include <optional>
#include <string>

#include "adapters/sources/diagnostics.hpp"

namespace window_ingress::adapters {

/// The vehicle's attitude at the time of an image, from tf. A transform may come later than the image:
/// that one goes without, and only what lasts is told.
class TfAttitude {
 public:
  TfAttitude(const tf2_ros::Buffer& tf, const std::string& odom_frame, const std::string& base_frame);

  std::optional<Eigen::Quaterniond> at(double stamp_sec);
  Health health() const;

 private:
  const tf2_ros::Buffer& tf_;
  std::string odom_frame_, base_frame_, fault_;
  double known_sec_, asked_sec_;  // when it was last known and last asked for, on the steady clock
};

}  // namespace window_ingress::adapters
