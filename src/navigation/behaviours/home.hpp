#pragma once

#include <Eigen/Core>
#include <optional>

#include "navigation/behaviours/behaviour.hpp"

namespace window_ingress::navigation {

/// Where the mission began, for the fence. When odometry jumps, home keeps its place relative to the vehicle.
class Home {
 public:
  /// Updates `MissionState::home_odom_m`; the first call sets it.
  void follow(const VehicleState& vehicle, MissionState& mission) {
    const Eigen::Vector3d position = vehicle.T_odom_base.translation();
    if (!mission.home_odom_m) from_home_m_ = Eigen::Vector3d::Zero();
    if (!position_odom_m_ || !mission.home_odom_m) mission.home_odom_m = position - from_home_m_;
    position_odom_m_ = position;
    from_home_m_ = position - *mission.home_odom_m;
  }

  void odometryJumped() { position_odom_m_.reset(); }
  double awayM() const { return from_home_m_.head<2>().norm(); }  ///< horizontal, of the vehicle from home

 private:
  std::optional<Eigen::Vector3d> position_odom_m_;  ///< at the previous call, in the present odometry frame
  Eigen::Vector3d from_home_m_ = Eigen::Vector3d::Zero();
};

}  // namespace window_ingress::navigation
