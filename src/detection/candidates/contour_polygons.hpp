#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "detection/candidates/candidate.hpp"
#include "window_ingress/detection/detector_params.hpp"

namespace window_ingress::detection {

/// Four lines round a convex polygon: removes the side that adds the least area until four are left.
/// \return nothing if fewer than four points are given or the lines do not close
/// \param buffer working memory
std::optional<geometry::Quadrilateral> quadRoundHull(const std::vector<cv::Point>& hull,
                                                     std::vector<Eigen::Vector2d>& buffer);

/// Closed contours to quadrilaterals (P7).
class ContourPolygons {
 public:
  struct Result {
    std::vector<Candidate> candidates;
    std::vector<CandidateTrace> rejected;  ///< long outlines without four corners; quad in search pixels
    int contours = 0;
    bool budget_exceeded = false;
  };

  explicit ContourPolygons(const ContourPolygonsParams& params) : params_(params) {}

  /// \param closed CV_8UC1, edges after closing; not changed
  /// \param dilation_px growth of edges by the closing, on each side; removed again
  /// \param source type of the outlines: edges or blobs
  /// Valid until the next call.
  const Result& run(const cv::Mat& closed, double dilation_px,
                    CandidateSource source = CandidateSource::kContour);

 private:
  void look(const std::vector<cv::Point>& outline, double min_perimeter_px, double grow_px);

  ContourPolygonsParams params_;
  CandidateSource source_ = CandidateSource::kContour;
  std::vector<std::vector<cv::Point>> outlines_;
  std::vector<cv::Vec4i> tree_;
  std::vector<cv::Point> hull_, polygon_;
  std::vector<Eigen::Vector2d> lines_;
  Result result_;
};

}  // namespace window_ingress::detection
