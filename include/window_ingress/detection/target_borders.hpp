#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/candidate_search.hpp"
#include "window_ingress/detection/frame_model.hpp"

namespace window_ingress::detection {

/// From a candidate on the search level to borders in the full image, directly or by way of the frame.
class TargetBorders {
 public:
  explicit TargetBorders(const BorderRefinementParams& params) : refinement_(params) {}

  /// Borders of the rival as it was seen.
  /// \param factor pixels of the image a pixel of the search level
  std::optional<RefinedBorders> seen(const cv::Mat& image, const Rival& rival, int factor,
                                     const geometry::PinholeCamera* camera, double* worst_inliers) const;

  /// Borders of an opening that the outer border of its frame foretells: the outer border is fitted first;
  /// then each inner one is the first edge that one meets coming from the frame. Where that edge does not
  /// show, or where it lies further from the foretold place than the frame allows, the foretold place stands,
  /// with its uncertainty.
  std::optional<RefinedBorders> foretold(const cv::Mat& image, const Rival& rival, const FrameModel& frame,
                                         int factor, const geometry::PinholeCamera* camera,
                                         double* worst_inliers) const;

  /// The frame in a reference picture, from the loops that were found in it.
  std::optional<FrameModel> learn(const cv::Mat& picture, const geometry::Quadrilateral& opening,
                                  const std::vector<Rival>& loops, int factor,
                                  const NestedLoopsParams& params) const;

 private:
  BorderRefinement refinement_;
};

}  // namespace window_ingress::detection
