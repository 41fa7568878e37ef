#include "detection/candidates/candidate_score.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr double kSupportLow = 0.4;         ///< support of a side that counts as none
constexpr double kAreaFull = 0.06;          ///< area above which size does not affect the rank [image areas]
constexpr double kAreaWeight = 0.45;        ///< exponent of the area's part in the rank
constexpr double kClosureWeight = 0.5;      ///< exponent of the closure's part
constexpr double kGeometryWeight = 0.25;    ///< exponent of the geometry score if there is a reference
constexpr double kBorderScoreWeight = 0.7;  ///< exponent of the borders' score, see ReferenceBorders

}  // namespace

double windowScore(const Candidate& candidate) {
  const Support support(candidate.sides);
  const double share = (0.5 * (support.least + support.mean) - kSupportLow) / (1.0 - kSupportLow);
  return std::clamp(share, 0.0, 1.0) * std::pow(candidate.closure, kClosureWeight) *
         (1.0 - support.overshoot);
}

double scoreWithReference(double geometry, double border_score) {
  return std::pow(geometry, kGeometryWeight) * std::pow(border_score, kBorderScoreWeight);
}

double sizeRank(const geometry::Quadrilateral& quad, const cv::Size& image) {
  const double area = std::abs(geometry::signedArea(quad)) / std::max(1, image.area());
  return std::pow(std::min(1.0, area / kAreaFull), kAreaWeight);
}

}  // namespace window_ingress::detection
