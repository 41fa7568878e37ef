#pragma once

namespace window_ingress::detection {

class RingView;

/// How well the surroundings of a quadrilateral match those of the opening in the reference image.
struct RingMatch {
  double correlation =
      -1.0;               ///< of logarithmic colours, each segment with its own gain and offset; at most 1
  double faithful = 0.0;  ///< `correlation`, counting only segments with the contrast of the reference
  double contrast = 1.0;  ///< relative to the reference's; reduced by haze
  double faithful_uncovered = 0.0;  ///< `faithful` without the worst third of the ring
};

/// Scores how well a view matches the reference, also where something stands before the ring: samples that
/// differ far more than most count less. \param view at the place, with all its samples; their weights are
/// changed
RingMatch matchOf(RingView& view);

}  // namespace window_ingress::detection
