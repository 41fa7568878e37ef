#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detection/candidates/candidate.hpp"

namespace window_ingress::detection {

/// True if `inner` lies within `outer` with a border of about the same width all round.
/// \param tolerance_px uncertainty of that width [px]
bool isConcentric(const geometry::Quadrilateral& outer, const geometry::Quadrilateral& inner,
                  double tolerance_px);

/// Chooses among loops that lie in each other by their geometry alone, and sets their verdicts. Of loops
/// round the same centre the front inner border of the opening wins: from the outermost loop inwards as long
/// as the ring passed over is uniform, as the four sides of a frame are (same plane, same paint) and those of
/// a reveal are not. Without a uniform ring there is no frame: the outermost loop is the opening's front. A
/// loop that holds panes wins over each of them. \param factor pixels of the image a pixel of the search
/// level
void judgeNestedQuads(const cv::Mat& image, int factor, std::vector<ScoredCandidate>& rivals);

}  // namespace window_ingress::detection
