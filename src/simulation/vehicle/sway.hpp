#pragma once

#include <Eigen/Geometry>

#include "simulation/scenario/house_params.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// Where a swinging house is, and what a vehicle looks like from it.
class Sway {
 public:
  /// \param R_odom_window axes of the window: x through it, y to the left
  Sway(const SwayParams& params, const Eigen::Matrix3d& R_odom_window);

  Eigen::Vector3d offsetOdom(double time_sec) const;    ///< from its resting place [m]
  Eigen::Vector3d velocityOdom(double time_sec) const;  ///< [m/s]

  /// The vehicle's place and velocity beside the house as if that stood at its resting place.
  VehicleTruth besideHouse(VehicleTruth vehicle, double time_sec) const;

 private:
  double phase(double time_sec) const;

  SwayParams params_;
  Eigen::Vector3d direction_odom_;
};

}  // namespace window_ingress::simulation
