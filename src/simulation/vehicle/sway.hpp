#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "simulation/scenario/house_params.hpp"
#include "simulation/vehicle/vehicle_truth.hpp"

namespace window_ingress::simulation {

/// Position of a swinging house, and the vehicle's state relative to it.
class Sway {
 public:
  /// \param R_odom_window axes of the window: x through the opening, y to the left
  Sway(const SwayParams& params, const Eigen::Matrix3d& R_odom_window)
      : params_(params),
        direction_odom_(R_odom_window * Eigen::Vector3d(std::sin(params.direction_rad),
                                                        std::cos(params.direction_rad), 0.0)) {}

  /// Offset from the resting place [m].
  Eigen::Vector3d offsetOdom(double time_sec) const {
    return params_.amplitude_m * std::sin(phase(time_sec)) * direction_odom_;
  }

  /// Velocity of the house [m/s].
  Eigen::Vector3d velocityOdom(double time_sec) const {
    const double rate_radps = 2.0 * M_PI / params_.period_sec;
    return params_.amplitude_m * rate_radps * std::cos(phase(time_sec)) * direction_odom_;
  }

  /// The vehicle's place and velocity relative to the house, as if the house were at its resting place.
  VehicleTruth besideHouse(VehicleTruth vehicle, double time_sec) const {
    vehicle.T_odom_base.translation() -= offsetOdom(time_sec);
    vehicle.velocity_odom_mps -= velocityOdom(time_sec);
    return vehicle;
  }

 private:
  double phase(double time_sec) const {
    return params_.phase_rad + 2.0 * M_PI * time_sec / params_.period_sec;
  }

  SwayParams params_;
  Eigen::Vector3d direction_odom_;
};

}  // namespace window_ingress::simulation
