#include "detection/candidates/candidate_gates.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/image_border.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kBorderPart = 0.003;     ///< a corner is cut off this close to the border [longer sides]
constexpr double kMeanSideSupport = 0.7;  ///< least mean support of the four sides
constexpr double kMinSolidity = 0.8;      ///< area of an outline over that of its hull
constexpr double kRightAngle = 1.5707963267948966;

}  // namespace

std::optional<Rejection> shapeFault(const Candidate& candidate, const cv::Size& image,
                                    const CandidateGatesParams& params) {
  if (!geometry::isFinite(candidate.quad) || !geometry::isConvex(candidate.quad))
    return Rejection{RejectReason::kCorners, 0.0, 4.0};
  const double area = std::abs(geometry::signedArea(candidate.quad)) / image.area();
  if (area < params.min_area) return Rejection{RejectReason::kAreaSmall, area, params.min_area};
  if (area > params.max_area) return Rejection{RejectReason::kAreaLarge, area, params.max_area};
  const double aspect = geometry::aspectRatio(candidate.quad);
  if (aspect < params.min_aspect) return Rejection{RejectReason::kAspect, aspect, params.min_aspect};
  if (aspect > params.max_aspect) return Rejection{RejectReason::kAspect, aspect, params.max_aspect};
  if (candidate.solidity < kMinSolidity)
    return Rejection{RejectReason::kSolidity, candidate.solidity, kMinSolidity};
  double angle = 0.0;
  for (double one : geometry::interiorAngles(candidate.quad))
    angle = std::max(angle, std::abs(one - kRightAngle));
  if (angle > params.max_angle_rad) return Rejection{RejectReason::kAngle, angle, params.max_angle_rad};
  const double margin = geometry::distanceToBorder(candidate.seen, image.width, image.height);
  const double limit = kBorderPart * std::max(image.width, image.height);
  if (margin < limit) return Rejection{RejectReason::kBorder, margin, limit};
  return std::nullopt;
}

std::optional<Rejection> supportFault(const Candidate& candidate, const CandidateGatesParams& params) {
  const Support support(candidate.sides);
  if (support.least < params.min_side_support)
    return Rejection{RejectReason::kLineSupport, support.least, params.min_side_support};
  if (support.mean < kMeanSideSupport)
    return Rejection{RejectReason::kLineSupport, support.mean, kMeanSideSupport};
  if (support.contrast < params.min_contrast)
    return Rejection{RejectReason::kContrast, support.contrast, params.min_contrast};
  return std::nullopt;
}

}  // namespace window_ingress::detection
