#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Closes gaps of an edge map by dilation (P6). This affects only the search. \param edges, closed CV_8UC1
/// \return how far borders move outwards [px]
int closeGaps(const cv::Mat& edges, const DilationParams& params, cv::Mat& closed);

/// Four lines round a convex polygon: removes the side that adds the least area until four are left.
/// \return nothing if fewer than four points are given or the lines do not close
std::optional<geometry::Quadrilateral> quadRoundHull(const std::vector<cv::Point>& hull);

/// What the contours of masks have become.
struct Outlines {
  std::vector<Candidate> candidates;     ///< in the raw level
  std::vector<CandidateTrace> rejected;  ///< long ones without four corners; quad in search pixels
  int contours = 0;
  bool budget_exceeded = false;
};

/// Adds the quadrilaterals that the closed contours of a mask are (P7).
/// \param closed CV_8UC1, edges after closing
/// \param dilation_px growth of edges by the closing, on each side; removed again
/// \param source type of the outlines: edges or blobs
void addOutlines(const cv::Mat& closed, int dilation_px, const ContourPolygonsParams& params,
                 CandidateSource source, Outlines& outlines);

}  // namespace window_ingress::detection
