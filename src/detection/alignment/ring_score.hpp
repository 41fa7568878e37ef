#pragma once

#include "detection/alignment/ring_view.hpp"

namespace window_ingress::detection {

/// How far what lies round a quadrilateral is what lies round the opening in the reference image.
struct RingMatch {
  double correlation =
      -1.0;  ///< of logarithms of colours, each segment with a gain and offset of its own; at most 1
  double faithful = 0.0;  ///< correlation of which only counts what has the contrast of the reference, too
  double contrast = 1.0;  ///< over the reference's; less through haze
  double faithful_uncovered = 0.0;  ///< the same without the third of the ring that fits worst
};

/// How far what a view shows is what the reference shows, also where something stands before the ring:
/// samples that differ far more than most count less.
/// \param view of the place, with all its samples; their weights are changed
RingMatch matchOf(RingView& view);

}  // namespace window_ingress::detection
