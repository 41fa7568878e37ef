#include "detection/candidates/candidate_gates.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr double kRightAngle = 1.5707963267948966;

double worstAngle(const geometry::Quadrilateral& quad) {
  double worst = 0.0;
  for (double angle : geometry::interiorAngles(quad)) worst = std::max(worst, std::abs(angle - kRightAngle));
  return worst;
}

double distanceToBorder(const geometry::Quadrilateral& quad, const cv::Size& image) {
  double least = std::max(image.width, image.height);
  for (const Eigen::Vector2d& p : quad)
    least = std::min({least, p.x(), p.y(), image.width - 1 - p.x(), image.height - 1 - p.y()});
  return least;
}

}  // namespace

std::optional<Rejection> CandidateGates::shape(const Candidate& candidate, const cv::Size& image) const {
  if (!geometry::isFinite(candidate.quad) || !geometry::isConvex(candidate.quad))
    return Rejection{RejectReason::kCorners, 0.0, 4.0};
  const double area = std::abs(geometry::signedArea(candidate.quad)) / image.area();
  if (area < params_.min_area) return Rejection{RejectReason::kAreaSmall, area, params_.min_area};
  if (area > params_.max_area) return Rejection{RejectReason::kAreaLarge, area, params_.max_area};
  const double aspect = geometry::aspectRatio(candidate.quad);
  if (aspect < params_.min_aspect) return Rejection{RejectReason::kAspect, aspect, params_.min_aspect};
  if (aspect > params_.max_aspect) return Rejection{RejectReason::kAspect, aspect, params_.max_aspect};
  if (candidate.solidity < params_.min_solidity)
    return Rejection{RejectReason::kSolidity, candidate.solidity, params_.min_solidity};
  const double angle = worstAngle(candidate.quad);
  if (angle > params_.max_angle_rad) return Rejection{RejectReason::kAngle, angle, params_.max_angle_rad};
  const double margin = distanceToBorder(candidate.seen, image);
  const double limit = params_.border * std::max(image.width, image.height);
  if (margin < limit) return Rejection{RejectReason::kBorder, margin, limit};
  return std::nullopt;
}

std::optional<Rejection> CandidateGates::support(const Candidate& candidate) const {
  double least = 1.0, sum = 0.0, contrast = 255.0;
  for (const SideSupport& side : candidate.sides) {
    least = std::min(least, side.fraction);
    sum += side.fraction;
    contrast = std::min(contrast, side.contrast);
  }
  if (least < params_.min_side_support)
    return Rejection{RejectReason::kLineSupport, least, params_.min_side_support};
  if (sum / 4.0 < params_.mean_side_support)
    return Rejection{RejectReason::kLineSupport, sum / 4.0, params_.mean_side_support};
  if (contrast < params_.min_contrast)
    return Rejection{RejectReason::kContrast, contrast, params_.min_contrast};
  return std::nullopt;
}

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
