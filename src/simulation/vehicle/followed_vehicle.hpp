#pragma once

#include <algorithm>
#include <cmath>
#include <deque>
#include <iterator>
#include <stdexcept>

#include "simulation/vehicle/vehicle_truth.hpp"
#include "window_ingress/geometry/frames.hpp"

namespace window_ingress::simulation {

/// An external vehicle: moves evenly between the given poses, and stays at the last one.
class FollowedVehicle {
 public:
  static constexpr double kMemorySec = 1.0;

  explicit FollowedVehicle(const Eigen::Isometry3d& T_odom_base) { truth_.T_odom_base = T_odom_base; }

  /// Gives the vehicle's state at this time. The first one applies at once. \throws std::invalid_argument
  /// unless all numbers are finite and the times increase
  void follow(const VehicleTruth& truth, double stamp_sec) {
    if (!geometry::isValidPose(truth.T_odom_base) || !truth.velocity_odom_mps.allFinite() ||
        !truth.angular_velocity_base_radps.allFinite() || !std::isfinite(stamp_sec))
      throw std::invalid_argument("pose, twist or stamp of the followed vehicle is not finite");
    if (!path_.empty() && stamp_sec <= path_.back().stamp_sec)
      throw std::invalid_argument("stamp of the followed vehicle is not after the previous one");
    while (path_.size() > 1 && path_[1].stamp_sec <= path_.back().stamp_sec - kMemorySec) path_.pop_front();
    if (path_.empty()) truth_ = truth;
    path_.push_back({truth, stamp_sec});
  }

  void moveTo(double now_sec) {
    if (path_.empty()) return;
    truth_ = at(now_sec);
    const VehicleTruth before = at(now_sec - kMemorySec);
    flown_odom_mps_ = (truth_.T_odom_base.translation() - before.T_odom_base.translation()) / kMemorySec;
  }

  /// The state as given, twist included.
  const VehicleTruth& truth() const { return truth_; }
  /// Velocity over the past second from positions alone, because a twist has bias and noise [m/s].
  const Eigen::Vector3d& flownVelocity() const { return flown_odom_mps_; }

 private:
  static VehicleTruth between(const VehicleTruth& a, const VehicleTruth& b, double fraction) {
    const Eigen::Quaterniond qa(a.T_odom_base.linear()), qb(b.T_odom_base.linear());
    const auto mix = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& to) -> Eigen::Vector3d {
      return from + fraction * (to - from);
    };
    return {geometry::makePose(qa.slerp(fraction, qb).normalized().toRotationMatrix(),
                               mix(a.T_odom_base.translation(), b.T_odom_base.translation())),
            mix(a.velocity_odom_mps, b.velocity_odom_mps),
            mix(a.angular_velocity_base_radps, b.angular_velocity_base_radps)};
  }

  struct Waypoint {
    VehicleTruth truth;
    double stamp_sec = 0.0;
  };
  VehicleTruth at(double time_sec) const {
    const auto to = std::find_if(path_.begin(), path_.end(),
                                 [&](const Waypoint& waypoint) { return waypoint.stamp_sec >= time_sec; });
    if (to == path_.begin()) return to->truth;
    if (to == path_.end()) return path_.back().truth;
    const auto from = std::prev(to);
    return between(from->truth, to->truth, (time_sec - from->stamp_sec) / (to->stamp_sec - from->stamp_sec));
  }

  VehicleTruth truth_;
  Eigen::Vector3d flown_odom_mps_ = Eigen::Vector3d::Zero();
  std::deque<Waypoint> path_;  // the past second, and one waypoint before it
};

}  // namespace window_ingress::simulation
