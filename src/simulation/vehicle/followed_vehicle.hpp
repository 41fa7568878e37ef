#pragma once

#include <deque>

#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// A vehicle that is simulated elsewhere: between the poses that are told it moves evenly, after the last one
/// it stays.
class FollowedVehicle {
 public:
  static constexpr double kMemorySec = 1.0;

  explicit FollowedVehicle(const Eigen::Isometry3d& T_odom_base) { truth_.T_odom_base = T_odom_base; }

  /// The vehicle is there at that time. The first one counts at once. \throws std::invalid_argument unless
  /// all numbers are finite and the times increase
  void follow(const VehicleTruth& truth, double stamp_sec);
  void moveTo(double now_sec);
  /// As told, the twist, too.
  const VehicleTruth& truth() const { return truth_; }
  /// Over the past second, by the places alone: a twist has a bias and noise that no place follows [m/s].
  const Eigen::Vector3d& flownVelocity() const { return flown_odom_mps_; }

 private:
  struct Waypoint {
    VehicleTruth truth;
    double stamp_sec = 0.0;
  };
  VehicleTruth at(double time_sec) const;
  VehicleTruth truth_;
  Eigen::Vector3d flown_odom_mps_ = Eigen::Vector3d::Zero();
  std::deque<Waypoint> path_;  // of the past second, with the one before it
};

}  // namespace window_ingress::simulation
