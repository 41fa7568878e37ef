#pragma once

#include <Eigen/Core>

#include "window_ingress/simulation/random_stream.hpp"
#include "window_ingress/simulation/scenario.hpp"

namespace window_ingress::simulation {

/// Steady wind and gusts; gusts are a first-order Gauss-Markov process on each axis.
class Wind {
 public:
  Wind(const WindParams& params, std::uint32_t seed);

  Eigen::Vector3d steadyInWindow() const { return steady_mps_; }  ///< axes of the window [m/s]
  Eigen::Vector3d step(double step_sec);  ///< wind of this step, axes of the window [m/s]

 private:
  WindParams params_;
  Eigen::Vector3d steady_mps_;
  Eigen::Vector3d gust_mps_ = Eigen::Vector3d::Zero();
  RandomStream random_;
};

}  // namespace window_ingress::simulation
