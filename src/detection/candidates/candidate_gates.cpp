#include "detection/candidates/candidate_gates.hpp"

#include <algorithm>
#include <cmath>

#include "window_ingress/geometry/image_border.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kSupportLow = 0.4;         ///< support of a side that counts as none
constexpr double kOvershootWeight = 1.0;    ///< exponent of one minus the overshoot
constexpr double kAreaFull = 0.06;          ///< area above which size does not affect the rank [image areas]
constexpr double kAreaWeight = 0.45;        ///< exponent of the area's part in the rank
constexpr double kClosureWeight = 0.5;      ///< exponent of the closure's part
constexpr double kGeometryWeight = 0.25;    ///< exponent of the geometry score if there is a reference
constexpr double kBorderScoreWeight = 0.7;  ///< exponent of the borders' score, see ReferenceBorders
constexpr double kBorderPart = 0.003;       ///< a corner is cut off this close to the border [longer sides]
constexpr double kMeanSideSupport = 0.7;    ///< least mean support of the four sides
constexpr double kMinSolidity = 0.8;        ///< area of an outline over that of its hull
constexpr double kRightAngle = 1.5707963267948966;

/// Support of all four sides.
struct Support {
  explicit Support(const std::array<SideSupport, 4>& sides) {
    for (const SideSupport& side : sides) {
      least = std::min(least, side.fraction);
      mean += 0.25 * side.fraction;
      contrast = std::min(contrast, side.contrast);
      overshoot += 0.25 * side.overshoot;
    }
  }
  double least = 1.0, mean = 0.0, contrast = 255.0, overshoot = 0.0;
};

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

double windowScore(const Candidate& candidate) {
  const Support support(candidate.sides);
  const double share = (0.5 * (support.least + support.mean) - kSupportLow) / (1.0 - kSupportLow);
  return std::clamp(share, 0.0, 1.0) * std::pow(candidate.closure, kClosureWeight) *
         std::pow(1.0 - support.overshoot, kOvershootWeight);
}

double scoreWithReference(double geometry, double border_score) {
  return std::pow(geometry, kGeometryWeight) * std::pow(border_score, kBorderScoreWeight);
}

double sizeRank(const geometry::Quadrilateral& quad, const cv::Size& image) {
  const double area = std::abs(geometry::signedArea(quad)) / std::max(1, image.area());
  return std::pow(std::min(1.0, area / kAreaFull), kAreaWeight);
}

}  // namespace window_ingress::detection
