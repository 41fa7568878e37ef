#pragma once

#include <optional>
#include <string>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::navigation {

/// Detects odometry whose driver fills in the pose alone, or of the velocity the vertical part alone: the
/// position moves sideways while the velocity forward and to the left is exactly zero, as no estimate is, not
/// even of a vehicle that stands. A jump of the position is no motion.
class EmptyTwist {
 public:
  static constexpr double kMovedM = 0.3, kWithinSec = 3.0, kJumpM = 0.2, kZeroMps = 1e-6;

  /// \return the fault, until there is a velocity, or an empty text
  std::string look(const VehicleState& vehicle) {
    const Place now{vehicle.stamp_sec, vehicle.T_odom_base.translation().head<2>()};
    const Eigen::Vector3d twist_mps = vehicle.T_odom_base.linear().transpose() * vehicle.velocity_odom_mps;
    if (twist_mps.head<2>().norm() > kZeroMps) {
      from_.reset();
      has_moved_ = false;
    } else if (!from_ || (now.position_m - last_.position_m).norm() > kJumpM ||
               now.stamp_sec - from_->stamp_sec > kWithinSec) {
      from_ = now;
    }
    last_ = now;
    has_moved_ = has_moved_ || (from_ && (now.position_m - from_->position_m).norm() > kMovedM);
    return has_moved_ ? "twist is zero while the position moves" : "";
  }

 private:
  struct Place {
    double stamp_sec;
    Eigen::Vector2d position_m;
  };
  Place last_{};
  std::optional<Place> from_;  ///< while there is no velocity
  bool has_moved_ = false;
};

}  // namespace window_ingress::navigation
