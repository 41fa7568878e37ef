#pragma once

#include <vector>

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
/// samples that differ far more than most count less. Keeps its memory.
class RingScore {
 public:
  /// \param view of the place, with all its samples; their weights are changed
  RingMatch of(RingView& view);

 private:
  /// What a segment adds to the likeness of its weight, and with which contrast, beside the reference's.
  struct Share {
    double alike, weight, covered_weight, gain, variance;  ///< variance: of the logarithm of the gain
    double faithful;                                       ///< of `alike`
  };
  void shareOut(const RingView& view);
  double weighContrasts();

  std::vector<Share> shares_;
  std::vector<WeightedPart> parts_;
  RingCorrelation correlation_;
  std::vector<float> gains_;
};

}  // namespace window_ingress::detection
