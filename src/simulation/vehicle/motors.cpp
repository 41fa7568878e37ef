#include "simulation/vehicle/motors.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::simulation {
namespace {

constexpr double kMotorTimeConstant_sec = 0.04;

}  // namespace

double lagPart(double step_sec, double time_constant_sec) {
  return 1.0 - std::exp(-step_sec / time_constant_sec);
}

Motors::Motors(const QuadrotorParams& params)
    : gain_((1.0 + params.thrust_gain_error) / params.massRatio()), wanted_mps2_(kGravity_mps2 / gain_) {}

double Motors::step(double wanted_mps2, double step_sec) {
  const double wanted = std::clamp(wanted_mps2, kMinThrust_mps2, kMaxThrust_mps2);
  wanted_mps2_ += lagPart(step_sec, kMotorTimeConstant_sec) * (wanted - wanted_mps2_);
  return gain_ * wanted_mps2_;
}

}  // namespace window_ingress::simulation
