#include "window_ingress/detection/window_score.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {

double windowScore(const Candidate& candidate, const cv::Size& level, const WindowScoreParams& params) {
  double least = 1.0, sum = 0.0, contrast = 0.0;
  for (const SideSupport& side : candidate.sides) {
    least = std::min(least, side.fraction);
    sum += 0.25 * side.fraction;
    contrast += 0.25 * std::min(1.0, side.contrast / params.contrast_full);
  }
  const double support =
      std::max(0.0, (0.5 * (least + sum) - params.support_low) / (1.0 - params.support_low));
  const double area = std::abs(geometry::signedArea(candidate.quad)) / std::max(1, level.area());
  return std::min(1.0, support) * std::pow(candidate.closure, params.closure_weight) *
         std::pow(contrast, params.contrast_weight) *
         std::pow(std::min(1.0, area / params.area_full), params.area_weight);
}

}  // namespace window_ingress::detection
