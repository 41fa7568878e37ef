#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "detection/candidates/candidate.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Why a candidate was stopped, and by how much.
struct Rejection {
  RejectReason reason = RejectReason::kNone;
  double value = 0.0;
  double limit = 0.0;
};

/// The paper's conditions on a candidate (P8), each a gate with a name. Those on the shape alone: corners,
/// area, aspect ratio, solidity, angles, border.
std::optional<Rejection> shapeFault(const Candidate& candidate, const cv::Size& image,
                                    const CandidateGatesParams& params);

/// Those on what the edge map says of its sides: line support, contrast.
std::optional<Rejection> supportFault(const Candidate& candidate, const CandidateGatesParams& params);

/// How much a candidate is like a window, by geometry alone: 0 (barely a quadrilateral) to 1. Product of the
/// support of its sides, the weakest counting most, and how well they end at their corners. It does not
/// depend on its size.
double windowScore(const Candidate& candidate);

/// The same where the borders of the reference were looked for: what they look like counts most.
/// \param worth of its borders, see ReferenceBorders
double scoreWithReference(double geometry, double worth);

/// Factor by which a larger candidate is preferred to a smaller one, up to 1.
double sizeRank(const geometry::Quadrilateral& quad, const cv::Size& image);

}  // namespace window_ingress::detection
