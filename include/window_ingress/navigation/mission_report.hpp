#pragma once

#include "window_ingress/navigation/behaviour.hpp"

namespace window_ingress::navigation {

/// How the vehicle answers, as measured in flight.
struct MeasuredVehicle {
  bool is_measured = false;        ///< else as assumed
  double response_sec = 0.0;       ///< from a setpoint to the velocity following it
  double acceleration_mps2 = 0.0;  ///< it changes its velocity no faster; infinite where no limit has shown
  Eigen::Vector3d velocity_bias_base_mps =
      Eigen::Vector3d::Zero();  ///< of odometry's velocity, taken off; level
};

/// Figures for people and reports; zero where the state has nothing to say.
struct NavigatorReport {
  bool has_relative = false;       ///< the next three are set
  double lateral_m = 0.0;          ///< of the vehicle in the window frame: y, left positive [m]
  double vertical_m = 0.0;         ///< z, up positive [m]
  double distance_m = 0.0;         ///< to the window's plane, positive in front [m]
  double commit_distance_m = 0.0;  ///< where COMMIT would begin now [m]
  double predicted_miss_m = 0.0;   ///< at the commit: offset, 3 sigma and drift, of the worse axis [m]
  double blind_sec = 0.0;       ///< longest time in COMMIT without sight of the window, up to its plane [s]
  int retries = 0;              ///< back-offs so far
  std::uint32_t window_id = 0;  ///< of the window flown at; 0: none, or it has no number
  std::vector<std::uint32_t> given_up;  ///< windows left for good on this mission, in that order
  MeasuredVehicle vehicle;
  bool next_window = false;  ///< after one of these the next best is to be the target
};

NavigatorReport reportOn(const Situation& situation, const MissionMemory& memory,
                         const NavigatorParams& params);

}  // namespace window_ingress::navigation
