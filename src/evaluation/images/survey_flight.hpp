#pragma once

#include <cstdint>
#include <vector>

#include "simulation/camera/camera_motion.hpp"

namespace window_ingress::evaluation {

/// The way of a camera to the window and what it does on it.
struct FlightRange {
  double nearest_start_m = 4.0, farthest_start_m = 7.0;  ///< distance of the start from the opening [m]
  double off_axis_rad = 0.5;  ///< of the start, to either side of the opening's normal, at most [rad]
  double end_m = 0.4;         ///< before the plane of the opening [m]
  double speed_mps = 1.5;     ///< towards the plane [m/s]
  double wobble_rad = 0.06;   ///< amplitude of roll, pitch and heading beside the way [rad]
};

/// A flight towards the opening's middle, drawn from the seed: from the start it curves onto the axis, looks
/// at the opening and wobbles about all axes, each at a rate of its own between 0.4 and 1.2 times a second.
/// Continuous and smooth.
class SurveyFlight {
 public:
  SurveyFlight(const FlightRange& range, std::uint32_t seed);

  double durationSec() const;  ///< until the end before the plane
  Eigen::Isometry3d T_window_camera(double time_sec) const;
  simulation::CameraMotion motion(double time_sec) const;  ///< velocities by central differences

 private:
  struct Wobble {
    double amplitude, rate_radps, phase_rad;
    double at(double time_sec) const;
  };

  FlightRange range_;
  Eigen::Vector3d start_;
  std::vector<Wobble> wobbles_;  ///< of roll, pitch, heading [rad], and of y and z [m]
};

}  // namespace window_ingress::evaluation
