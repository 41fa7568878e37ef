#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "detection/candidates/candidate.hpp"

namespace window_ingress::detection {

/// Chooses among nested loops by their geometry alone, and sets their verdicts. Among concentric loops the
/// front inner border of the opening wins: the search goes inwards from the outermost loop while the ring in
/// between is uniform. The four sides of a frame are uniform (same plane, same paint), those of a reveal are
/// not. Without a uniform ring there is no frame, and the outermost loop is the opening's front. A loop that
/// holds panes wins over each of them. \param factor image pixels per pixel of the search level
void judgeNestedQuads(const cv::Mat& image, int factor, std::vector<ScoredCandidate>& candidates);

}  // namespace window_ingress::detection
