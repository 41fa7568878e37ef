#include "window_ingress/detection/window_score.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {

double windowScore(const Candidate& candidate, const WindowScoreParams& params) {
  double least = 1.0, sum = 0.0, overshoot = 0.0;
  for (const SideSupport& side : candidate.sides) {
    least = std::min(least, side.fraction);
    sum += 0.25 * side.fraction;
    overshoot += 0.25 * side.overshoot;
  }
  const double support =
      std::max(0.0, (0.5 * (least + sum) - params.support_low) / (1.0 - params.support_low));
  return std::min(1.0, support) * std::pow(candidate.closure, params.closure_weight) *
         std::pow(1.0 - overshoot, params.overshoot_weight);
}

double scoreWithReference(double geometry, double worth, const WindowScoreParams& params) {
  return std::pow(geometry, params.geometry_weight) * std::pow(worth, params.worth_weight);
}

double sizeRank(const geometry::Quadrilateral& quad, const cv::Size& image, const WindowScoreParams& params) {
  const double area = std::abs(geometry::signedArea(quad)) / std::max(1, image.area());
  return std::pow(std::min(1.0, area / params.area_full), params.area_weight);
}

}  // namespace window_ingress::detection
