#include "estimation/planar/covariance_scale.hpp"

#include <algorithm>
#include <array>

namespace window_ingress::estimation {
namespace {

constexpr int kPoseParameters = 6;
// 99 % of sums of 0, 1, .. 8 squares are smaller.
constexpr std::array<double, 9> kChiSquared99{6.63, 6.63, 9.21, 11.34, 13.28, 15.09, 16.81, 18.48, 20.09};

}  // namespace

double misfitOf(const RefinementProblem& problem, const PlanarSolution& best) {
  const int spare = problem.image.size() + (problem.prior ? kPoseParameters : 0) - kPoseParameters;
  const double beyond = 2.0 * best.cost - kChiSquared99[std::clamp(spare, 0, 8)];
  return 1.0 + std::max(0.0, beyond) / std::max(1, spare);
}

void widen(double factor, PlanarSolution& solution) {
  solution.covariance *= factor;
  solution.opening_log_covariance *= factor;
}

}  // namespace window_ingress::estimation
