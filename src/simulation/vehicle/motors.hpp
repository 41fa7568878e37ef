#pragma once

#include <algorithm>
#include <cmath>

#include "simulation/scenario/quadrotor_params.hpp"

namespace window_ingress::simulation {

constexpr double kGravity_mps2 = 9.81;

/// Bounds of the acceleration by thrust that the controllers ask for [m/s^2].
constexpr double kMinThrust_mps2 = 0.2 * kGravity_mps2;
constexpr double kMaxThrust_mps2 = 2.0 * kGravity_mps2;

/// Part of the way to its end that a first-order lag goes in one step.
inline double lagPart(double step_sec, double time_constant_sec) {
  return 1.0 - std::exp(-step_sec / time_constant_sec);
}

/// All motors as one: thrust follows what is asked for with a first-order lag, and is off by the error of its
/// gain and by a payload of which the controllers know nothing.
class Motors {
 public:
  /// They start with what carries the vehicle.
  explicit Motors(const QuadrotorParams& params)
      : gain_((1.0 + params.thrust_gain_error) / params.massRatio()), wanted_mps2_(kGravity_mps2 / gain_) {}

  /// Of the thrust given to the thrust wanted.
  double gain() const { return gain_; }
  void set(double wanted_mps2) { wanted_mps2_ = wanted_mps2; }  ///< at once, without lag
  /// \return acceleration by thrust at the end of the step [m/s^2]
  double step(double wanted_mps2, double step_sec) {
    const double wanted = std::clamp(wanted_mps2, kMinThrust_mps2, kMaxThrust_mps2);
    wanted_mps2_ += lagPart(step_sec, kMotorTimeConstant_sec) * (wanted - wanted_mps2_);
    return gain_ * wanted_mps2_;
  }

 private:
  static constexpr double kMotorTimeConstant_sec = 0.04;

  double gain_, wanted_mps2_;
};

}  // namespace window_ingress::simulation
