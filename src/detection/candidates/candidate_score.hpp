#pragma once

#include <opencv2/core.hpp>

#include "detection/candidates/candidate.hpp"

namespace window_ingress::detection {

/// How much a candidate resembles a window, by geometry alone: 0 (barely a quadrilateral) to 1. Product of
/// the support of its sides, the weakest counting most, and of how well they end at their corners.
/// Independent of its size.
double windowScore(const Candidate& candidate);

/// Score where the reference's borders were searched; their score counts most.
/// \param border_score of its borders, see ReferenceBorders
double scoreWithReference(double geometry, double border_score);

/// Factor that prefers larger candidates, up to 1.
double sizeRank(const geometry::Quadrilateral& quad, const cv::Size& image);

}  // namespace window_ingress::detection
