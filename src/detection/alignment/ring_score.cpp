#include "detection/alignment/ring_score.hpp"

#include <cmath>

#include "window_ingress/geometry/median.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kGainSpread =
    0.3;  ///< standard deviation of a segment's contrast relative to the whole ring's [1]
constexpr double kMinRingGain = 0.8,
                 kMaxRingGain = 1.25;  ///< of the ring: other exposure or tone curve

}  // namespace

RingMatch RingScore::of(RingView& view) {
  RingMatch match;
  shareOut(view);
  match.correlation = correlation_.value();
  if (!(correlation_.most > 0.0)) return match;
  match.contrast = weighContrasts();
  for (const Share& share : shares_) match.faithful += share.faithful / correlation_.most;
  view.coverOutliers(RingView::kCoverPasses);
  shareOut(view);
  weighContrasts();
  parts_.clear();
  for (const Share& share : shares_) {
    parts_.push_back({share.faithful, share.weight});
    if (share.covered_weight > 0.0) parts_.push_back({0.0, share.covered_weight});
  }
  match.faithful_uncovered = meanUncovered(parts_);
  return match;
}

void RingScore::shareOut(const RingView& view) {
  correlation_ = {};
  shares_.clear();
  for (int s = 0; s < view.ring().segmentCount(); ++s) {
    const RingSegment segment = view.segment(s);
    correlation_.add(segment);
    if (segment.weight > 0.0)
      shares_.push_back({segment.alike, segment.weight, segment.covered_weight, segment.gain,
                         kGainSpread * kGainSpread + segment.noise / segment.xx, 0.0});
  }
}

// A frame in another paint still correlates with the reference's; but its contrast with the wall differs.
double RingScore::weighContrasts() {
  gains_.clear();
  for (const Share& share : shares_)
    if (share.alike > 0.0 && share.gain > 0.0) gains_.push_back(static_cast<float>(share.gain));
  if (gains_.empty()) return 1.0;
  const float middle = geometry::median(gains_);
  const double contrast = std::clamp<double>(middle, kMinRingGain, kMaxRingGain);
  for (Share& share : shares_) {
    if (share.alike <= 0.0 || share.gain <= 0.0) continue;
    const double off = std::log(share.gain / contrast);
    share.faithful = share.alike * std::exp(-0.5 * off * off / share.variance);
  }
  return middle;
}

}  // namespace window_ingress::detection
