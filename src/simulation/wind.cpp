#include "window_ingress/simulation/wind.hpp"

#include <cmath>

namespace window_ingress::simulation {

Wind::Wind(const WindParams& params, std::uint32_t seed)
    : params_(params), steady_mps_(params.x_mps, params.y_mps, params.z_mps), random_(seed, "wind") {}

Eigen::Vector3d Wind::step(double step_sec) {
  if (params_.gust_mps == 0.0) return steady_mps_;
  const double kept = std::exp(-step_sec / params_.gust_time_constant_sec);
  const double fresh_mps = params_.gust_mps * std::sqrt(1.0 - kept * kept);
  for (int axis = 0; axis < 3; ++axis) gust_mps_[axis] = kept * gust_mps_[axis] + random_.normal(fresh_mps);
  return steady_mps_ + gust_mps_;
}

}  // namespace window_ingress::simulation
