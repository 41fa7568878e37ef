#pragma once

#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/detection/nested_loops.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// Where the opening lies within the outer border of its frame. Both lie in one plane, so that the outer
/// border, which stands out against the wall, tells where the inner one must be, from any direction.
struct FrameModel {
  /// Both as seen in one picture, canonical order.
  FrameModel(const geometry::Quadrilateral& outer, const geometry::Quadrilateral& opening);

  /// The opening within another view of the outer border.
  geometry::Quadrilateral inner(const geometry::Quadrilateral& outer_seen) const;

  geometry::Quadrilateral outer;  ///< in the picture that the model is from
  geometry::Quadrilateral
      inner_in_outer;  ///< corners of the opening where the outer border is the unit square
};

/// Finds the frame in a picture whose opening is known: the smallest loop round it with a uniform ring
/// between. \param loops quadrilaterals found in the picture, canonical order
std::optional<FrameModel> findFrame(const cv::Mat& picture, const geometry::Quadrilateral& opening,
                                    const std::vector<geometry::Quadrilateral>& loops,
                                    const NestedLoopsParams& params);

}  // namespace window_ingress::detection
