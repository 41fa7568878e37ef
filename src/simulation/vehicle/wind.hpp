#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulation/scenario/wind_params.hpp"
#include "simulation/vehicle/dryden_gusts.hpp"
#include "simulation/vehicle/quadrotor.hpp"
#include "window_ingress/geometry/opening.hpp"

namespace window_ingress::simulation {

/// Dimensions of the house for the air, axes of the window.
struct WallInAir {
  bool open = true;  ///< there is an opening around the origin
  geometry::OpeningSize opening;
  double front_x_m = 0.0;     ///< outer face of the wall
  double back_x_m = 0.24;     ///< inner face of the wall
  double half_width_m = 5.5;  ///< half width of the wall
  double ground_z_m = -1.5;
  double top_z_m = 1.6;  ///< top of the wall
};

/// Air around the house: steady wind and Dryden gusts outside, less of both in the room, a draught through
/// the opening, and a push towards the wall near it.
///
/// - Behind the wall's front, wind and gusts fall to `inside_part`, reached 0.3 m into the room.
/// - Draught: full speed between the borders of the opening (5 cm soft edges). Downstream a free jet: its
///   edges widen by 0.1 m per metre; its core ends after five hydraulic diameters, and then the speed falls
///   as 1/x. Upstream a sink after DallaValle towards the opening: V A / (A + 10 r^2), r the distance to the
///   opening, A its area.
/// - Wall: `wall_push_mps2` exp(-gap / `wall_push_length_m`) towards the wall's face on the vehicle's side,
///   where there is wall. The shape is assumed: measurements near walls agree on suction that vanishes within
///   some rotor radii, but not on a law.
class Wind {
 public:
  Wind(const WindParams& params, const WallInAir& wall, double vehicle_half_length_m, std::uint32_t seed);

  /// Wind without gusts [m/s].
  Eigen::Vector3d steadyAt(const Eigen::Vector3d& position_m) const;
  /// Effect on a vehicle with this position and velocity, axes of the window.
  Air step(double step_sec, const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_mps);

 private:
  double shelter(double x_m) const;
  double openAt(const Eigen::Vector3d& position_m, double soft_m) const;
  Eigen::Vector3d draughtAt(const Eigen::Vector3d& position_m) const;
  Eigen::Vector3d pushAt(const Eigen::Vector3d& position_m) const;
  Eigen::Vector3d gust(double step_sec, double height_m, const Eigen::Vector3d& velocity_mps);

  WindParams params_;
  WallInAir wall_;
  double vehicle_half_length_m_;
  Eigen::Vector3d steady_mps_;
  DrydenGusts gusts_;
};

}  // namespace window_ingress::simulation
