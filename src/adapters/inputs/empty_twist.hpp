#pragma once

#include <optional>
#include <string>

#include "window_ingress/navigation/navigation_types.hpp"

namespace window_ingress::adapters {

/// Detects odometry whose driver fills in the pose alone: the position moves while the velocity is exactly
/// zero.
class EmptyTwist {
 public:
  static constexpr double kMovedM = 0.3;

  /// \return a warning, or an empty text
  std::string look(const navigation::VehicleState& vehicle) {
    const Eigen::Vector3d position_m = vehicle.T_odom_base.translation();
    if (!vehicle.velocity_odom_mps.isZero(0.0))
      from_m_.reset();
    else if (!from_m_)
      from_m_ = position_m;
    if (!from_m_)
      has_moved_ = false;
    else
      has_moved_ = has_moved_ || (position_m - *from_m_).norm() > kMovedM;
    return has_moved_ ? "twist is all zero while the position moves" : "";
  }

 private:
  std::optional<Eigen::Vector3d> from_m_;  ///< first position without a velocity
  bool has_moved_ = false;
};

}  // namespace window_ingress::adapters
