#pragma once

#include <optional>

#include "window_ingress/simulation/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// A vehicle that is simulated elsewhere: between the poses that are told it moves evenly, after the last one
/// it stays.
class FollowedVehicle {
 public:
  explicit FollowedVehicle(const Eigen::Isometry3d& T_odom_base) { truth_.T_odom_base = T_odom_base; }

  /// The vehicle is there at that time. The first one counts at once. \throws std::invalid_argument unless
  /// all numbers are finite and the times increase
  void follow(const VehicleTruth& truth, double stamp_sec);
  void moveTo(double now_sec);
  const VehicleTruth& truth() const { return truth_; }

 private:
  struct Waypoint {
    VehicleTruth truth;
    double stamp_sec = 0.0;
  };
  VehicleTruth truth_;
  std::optional<Waypoint> from_, to_;
};

}  // namespace window_ingress::simulation
