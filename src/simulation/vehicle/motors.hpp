#pragma once

#include "simulation/scenario/quadrotor_params.hpp"

namespace window_ingress::simulation {

constexpr double kGravity_mps2 = 9.81;

/// Bounds of the acceleration by thrust that the controllers ask for [m/s^2].
constexpr double kMinThrust_mps2 = 0.2 * kGravity_mps2;
constexpr double kMaxThrust_mps2 = 2.0 * kGravity_mps2;

/// Part of the way to its end that a first-order lag goes in one step.
double lagPart(double step_sec, double time_constant_sec);

/// All motors as one: thrust follows what is asked for with a first-order lag, and is off by the error of its
/// gain and by a payload of which the controllers know nothing.
class Motors {
 public:
  /// They start with what carries the vehicle.
  explicit Motors(const QuadrotorParams& params);

  /// Of the thrust given to the thrust wanted.
  double gain() const { return gain_; }
  void set(double wanted_mps2) { wanted_mps2_ = wanted_mps2; }  ///< at once, without lag
  /// \return acceleration by thrust at the end of the step [m/s^2]
  double step(double wanted_mps2, double step_sec);

 private:
  double gain_, wanted_mps2_;
};

}  // namespace window_ingress::simulation
