#include "detection/alignment/ring_score.hpp"

#include <cmath>

#include "window_ingress/geometry/median.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kGainSpread =
    0.3;  ///< of a segment's contrast over the whole ring's: standard deviation [1]
constexpr double kMinRingGain = 0.8, kMaxRingGain = 1.25;  ///< of the ring: another exposure or tone curve

/// What a segment adds to the likeness of its weight, and with which contrast, beside the reference's.
struct Share {
  double alike, weight, covered_weight, gain, variance;  ///< variance: of the logarithm of the gain
  double faithful;                                       ///< of `alike`
};

// What each segment adds; those that can tell something.
std::vector<Share> sharesOf(const RingView& view, RingCorrelation& correlation) {
  std::vector<Share> shares;
  for (int s = 0; s < view.ring().segmentCount(); ++s) {
    const RingSegment segment = view.segment(s);
    correlation.add(segment);
    if (segment.weight > 0.0)
      shares.push_back({segment.alike, segment.weight, segment.covered_weight, segment.gain,
                        kGainSpread * kGainSpread + segment.noise / segment.xx, 0.0});
  }
  return shares;
}

// A frame in another paint correlates with the reference's; its contrast with the wall is another.
double weighContrasts(std::vector<Share>& shares) {
  std::vector<float> gains;
  for (const Share& share : shares)
    if (share.alike > 0.0 && share.gain > 0.0) gains.push_back(static_cast<float>(share.gain));
  if (gains.empty()) return 1.0;
  const float middle = geometry::median(gains);
  const double contrast = std::clamp<double>(middle, kMinRingGain, kMaxRingGain);
  for (Share& share : shares) {
    if (share.alike <= 0.0 || share.gain <= 0.0) continue;
    const double off = std::log(share.gain / contrast);
    share.faithful = share.alike * std::exp(-0.5 * off * off / share.variance);
  }
  return middle;
}

}  // namespace

RingMatch matchOf(RingView& view) {
  RingMatch match;
  RingCorrelation correlation, uncovered;
  std::vector<Share> shares = sharesOf(view, correlation);
  match.correlation = correlation.value();
  if (!(correlation.most > 0.0)) return match;
  match.contrast = weighContrasts(shares);
  for (const Share& share : shares) match.faithful += share.faithful / correlation.most;
  view.coverOutliers(RingView::kCoverPasses);
  shares = sharesOf(view, uncovered);
  weighContrasts(shares);
  std::vector<WeightedPart> parts;
  for (const Share& share : shares) {
    parts.push_back({share.faithful, share.weight});
    if (share.covered_weight > 0.0) parts.push_back({0.0, share.covered_weight});
  }
  match.faithful_uncovered = meanUncovered(parts);
  return match;
}

}  // namespace window_ingress::detection
