#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "window_ingress/detection/candidate_search.hpp"
#include "window_ingress/detection/nested_loops.hpp"

namespace window_ingress::detection {

/// Which of the rivals is the opening, by their geometry alone: of the variants of a loop the best, of loops
/// round each other the front inner border.
class LoopJudge {
 public:
  explicit LoopJudge(const NestedLoopsParams& params) : params_(params), nested_(params) {}

  /// Sets the verdicts. \param factor pixels of the image a pixel of the search level
  void judge(const cv::Mat& image, int factor, std::vector<Rival>& rivals) const;

 private:
  bool isVariant(const geometry::Quadrilateral& a, const geometry::Quadrilateral& b,
                 double tolerance_px) const;
  std::vector<Rival*> bestOfVariants(std::vector<Rival>& rivals, double tolerance_px) const;

  NestedLoopsParams params_;
  NestedLoops nested_;
};

}  // namespace window_ingress::detection
