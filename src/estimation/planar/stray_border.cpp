#include "estimation/planar/stray_border.hpp"

#include <algorithm>
#include <cmath>

#include "estimation/planar/covariance_scale.hpp"

namespace window_ingress::estimation {
namespace {

constexpr double kStraySigma = 0.03;       // of a side's length
constexpr double kMinStrayEvidence = 7.5;  // for a stray border [nats]

// Where keystone alone knows the yaw far worse, the more evidence is needed: what looks like a stray border
// is then more likely keystone's own noise.
double neededEvidence(const WindowPoseEstimate& all) {
  return kMinStrayEvidence + 2.0 * std::log(std::max(1.0, all.sigma_u_rad / all.yaw_sigma_rad));
}

}  // namespace

std::optional<StrayBorder> withoutStrayBorder(const RefinementProblem& problem,
                                              const WindowPoseEstimate& all) {
  if (!problem.size_root.isZero(0.0) || !all.aspect || misfitOf(problem, all.best) <= 1.0)
    return std::nullopt;
  const bool is_narrow = all.aspect->ratio < problem.opening.width_m / problem.opening.height_m;
  RefinementProblem freed = problem;
  freed.size_root =
      Eigen::Vector2d(is_narrow ? kStraySigma : 0.0, is_narrow ? 0.0 : kStraySigma).asDiagonal();
  const auto solutions = planarSolutions(freed);
  if (!solutions || solutions->best.cost + neededEvidence(all) > all.best.cost) return std::nullopt;
  return StrayBorder{freed, *solutions};
}

}  // namespace window_ingress::estimation
