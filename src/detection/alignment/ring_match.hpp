#pragma once

namespace window_ingress::detection {

/// How far what lies round a quadrilateral is what lies round the opening in the reference image.
struct RingMatch {
  double correlation =
      -1.0;           ///< of logarithms of colours, each segment with a gain and offset of its own; at most 1
  double seen = 0.0;  ///< part of the ring that lies in the image
  double faithful = 0.0;  ///< correlation of which only counts what has the contrast of the reference, too
  double contrast = 1.0;  ///< over the reference's; less through haze
  double faithful_uncovered = 0.0;  ///< the same without the third of the ring that fits worst
};

}  // namespace window_ingress::detection
