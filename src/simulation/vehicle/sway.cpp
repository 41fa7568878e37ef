#include "simulation/vehicle/sway.hpp"

#include <cmath>

namespace window_ingress::simulation {

Sway::Sway(const SwayParams& params, const Eigen::Matrix3d& R_odom_window)
    : params_(params),
      direction_odom_(R_odom_window *
                      Eigen::Vector3d(std::sin(params.direction_rad), std::cos(params.direction_rad), 0.0)) {}

double Sway::phase(double time_sec) const {
  return params_.phase_rad + 2.0 * M_PI * time_sec / params_.period_sec;
}

Eigen::Vector3d Sway::offsetOdom(double time_sec) const {
  return params_.amplitude_m * std::sin(phase(time_sec)) * direction_odom_;
}

Eigen::Vector3d Sway::velocityOdom(double time_sec) const {
  const double rate_radps = 2.0 * M_PI / params_.period_sec;
  return params_.amplitude_m * rate_radps * std::cos(phase(time_sec)) * direction_odom_;
}

VehicleTruth Sway::besideHouse(VehicleTruth vehicle, double time_sec) const {
  vehicle.T_odom_base.translation() -= offsetOdom(time_sec);
  vehicle.velocity_odom_mps -= velocityOdom(time_sec);
  return vehicle;
}

}  // namespace window_ingress::simulation
