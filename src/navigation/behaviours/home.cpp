#include "navigation/behaviours/home.hpp"

namespace window_ingress::navigation {

void Home::follow(const VehicleState& vehicle, MissionState& memory) {
  const Eigen::Vector3d position = vehicle.T_odom_base.translation();
  if (!memory.home_odom_m) from_home_m_ = Eigen::Vector3d::Zero();
  if (!position_odom_m_ || !memory.home_odom_m) memory.home_odom_m = position - from_home_m_;
  position_odom_m_ = position;
  from_home_m_ = position - *memory.home_odom_m;
}

}  // namespace window_ingress::navigation
