#pragma once

#include <vector>

#include "detection/alignment/ring_view.hpp"

namespace window_ingress::detection {

/// How well the surroundings of a quadrilateral match those of the opening in the reference image.
struct RingMatch {
  double correlation =
      -1.0;               ///< of logarithmic colours, each segment with its own gain and offset; at most 1
  double faithful = 0.0;  ///< `correlation`, counting only segments with the contrast of the reference
  double contrast = 1.0;  ///< relative to the reference's; reduced by haze
  double faithful_uncovered = 0.0;  ///< `faithful` without the worst third of the ring
};

/// Scores how well a view matches the reference, also where something stands before the ring: samples that
/// differ far more than most count less. Keeps its memory.
class RingScore {
 public:
  /// \param view at the place, with all its samples; their weights are changed
  RingMatch of(RingView& view);

 private:
  /// Contribution of a segment to the match, and its contrast relative to the reference's.
  struct Share {
    double alike, weight, covered_weight, gain, variance;  ///< variance: of the logarithm of the gain
    double faithful;                                       ///< part of `alike`
  };
  void shareOut(const RingView& view);
  double weighContrasts();

  std::vector<Share> shares_;
  std::vector<WeightedPart> parts_;
  RingCorrelation correlation_;
  std::vector<float> gains_;
};

}  // namespace window_ingress::detection
