#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/detection/candidate.hpp"

namespace window_ingress::detection {

struct ContourPolygonsParams {
  double epsilon = 0.025;       ///< tolerance of the polygon, in perimeters of its outline
  double hull_excess = 0.12;    ///< the four lines round a hull may add this part of its area
  double min_perimeter = 0.08;  ///< shorter outlines are not looked at, in longer sides of the level
  double closure = 0.7;         ///< given to them: closed, but their corners are no better than the outline
  int max_contours = 3000;      ///< budget for one image; the rest is not looked at

  template <typename Self, typename Visitor>
  static void visit(Self& self, Visitor&& field) {
    field("epsilon", self.epsilon, 0.001, 0.2);
    field("hull_excess", self.hull_excess, 0.0, 1.0);
    field("min_perimeter", self.min_perimeter, 0.0, 4.0);
    field("closure", self.closure, 0.01, 1.0);
    field("max_contours", self.max_contours, 1, 1000000);
  }
};

/// Four lines round a convex polygon: removes the side that adds least area until four are left.
/// \return nothing if fewer than four points are given or the lines do not close
/// \param buffer memory for its work
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
  /// \param dilation_px what the closing added on each side of an edge; taken off again
  /// Valid until the next call.
  const Result& run(const cv::Mat& closed, double dilation_px);

 private:
  void look(const std::vector<cv::Point>& outline, double min_perimeter_px, double grow_px);

  ContourPolygonsParams params_;
  std::vector<std::vector<cv::Point>> outlines_;
  std::vector<cv::Vec4i> tree_;
  std::vector<cv::Point> hull_, polygon_;
  std::vector<Eigen::Vector2d> lines_;
  Result result_;
};

}  // namespace window_ingress::detection
