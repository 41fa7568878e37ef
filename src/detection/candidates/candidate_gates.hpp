#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "detection/candidates/candidate.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// The paper's conditions on a candidate (P8), each a named gate. These concern the shape alone: corners,
/// area, aspect ratio, solidity, angles, border.
std::optional<Rejection> shapeFault(const Candidate& candidate, const cv::Size& image,
                                    const CandidateGatesParams& params);

/// Gates on the support of its sides by the edge map: line support, contrast.
std::optional<Rejection> supportFault(const Candidate& candidate, const CandidateGatesParams& params);

}  // namespace window_ingress::detection
