#pragma once

#include <Eigen/Core>

#include "window_ingress/navigation/navigation_types.hpp"
#include "window_ingress/navigation/vehicle_params.hpp"

namespace window_ingress::navigation {

/// The vehicle's state in the window frame and its uncertainty. In front of the window x is negative.
struct RelativeState {
  Eigen::Vector3d position_window_m = Eigen::Vector3d::Zero();    ///< the body's centre
  Eigen::Vector3d velocity_window_mps = Eigen::Vector3d::Zero();  ///< relative to the window, in its axes
  double bearing_rad = 0.0;        ///< of the opening's centre against the vehicle's heading, left positive
  double heading_error_rad = 0.0;  ///< window's normal against the vehicle's heading, left positive
  /// Standard deviations of y and z [m]. That of y is for now or for the plane, where a wrong heading shows;
  /// the larger one.
  Eigen::Vector2d sigma_m = Eigen::Vector2d::Zero();

  /// To the window's plane, positive in front [m].
  double distance() const { return -position_window_m.x(); }
  double lateral() const { return position_window_m.y(); }
  double vertical() const { return position_window_m.z(); }
  /// Position after the vehicle's response time.
  Eigen::Vector3d coastedM(const VehicleParams& vehicle) const {
    return position_window_m + velocity_window_mps.cwiseProduct(vehicle.responsesSec());
  }
};

/// \param vehicle and \param target finite, in the same odometry frame
RelativeState relate(const VehicleState& vehicle, const TargetEstimate& target);

/// Rotation from window to odom axes by the window's heading alone.
Eigen::Matrix3d uprightRotation(const TargetEstimate& target);
/// Horizontal direction of flight through the window, odom axes.
Eigen::Vector3d normalOf(const TargetEstimate& target);

/// Distance between the centres of two windows [m].
double distanceBetween(const TargetEstimate& a, const TargetEstimate& b);

/// Nose-down pitch of the vehicle [rad].
double pitchOf(const VehicleState& vehicle);

}  // namespace window_ingress::navigation
