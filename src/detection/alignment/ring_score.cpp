#include "detection/alignment/ring_score.hpp"

#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr double kGainSpread =
    0.3;  ///< of a segment's contrast over the whole ring's: standard deviation [1]
constexpr int kCoverPasses = 3;
constexpr double kMinRingGain = 0.8, kMaxRingGain = 1.25;  ///< of the ring: another exposure or tone curve

}  // namespace

RingMatch RingScore::of(RingView& view, double seen) {
  RingMatch match;
  match.seen = seen;
  if (seen < RingView::kMinSeen) return match;
  shareOut(view);
  match.correlation = correlation_.value();
  if (!(correlation_.most > 0.0)) return match;
  match.contrast = weighContrasts();
  for (const Share& share : shares_) match.faithful += share.faithful / correlation_.most;
  for (int n = 0; n < kCoverPasses; ++n) coverOutliers(view);
  shareOut(view);
  weighContrasts();
  parts_.clear();
  for (const Share& share : shares_) parts_.push_back({share.faithful, share.weight});
  match.faithful_uncovered = meanUncovered(parts_);
  return match;
}

// What each segment adds.
void RingScore::shareOut(const RingView& view) {
  correlation_ = {};
  shares_.clear();
  for (int s = 0; s < view.ring().segmentCount(); ++s) {
    const RingSegment segment = view.segment(s);
    correlation_.add(segment);
    if (segment.weight > 0.0)
      shares_.push_back({segment.alike, segment.weight, segment.gain,
                         kGainSpread * kGainSpread + segment.noise / segment.xx, 0.0});
  }
}

// Where most of the ring fits well, what does not is something before it; where nothing fits, all counts.
void RingScore::coverOutliers(RingView& view) {
  const RingLevel& ring = view.ring();
  const std::size_t count = ring.x.size();
  residuals_.assign(count * view.channels(), 0.0F);
  for (int s = 0; s < ring.segmentCount(); ++s) {
    const RingSegment segment = view.segment(s);
    for (int c = 0; c < view.channels(); ++c) {
      const RingMoments& m = segment.moments[c];
      for (std::size_t i = segment.begin, at = c * count + i; static_cast<int>(i) < segment.end; ++i, ++at)
        residuals_[at] = view.value(at) - m.meanY() - segment.gain * (ring.values[at] - m.meanX());
    }
  }
  const float outlier = robustFactor(view.spreadOf(residuals_, RingView::kNoise));
  for (std::size_t i = 0; i < count; ++i) {
    if (view.weight(i) == 0.0F) continue;
    float squares = 0.0F;
    for (int c = 0; c < view.channels(); ++c)
      squares += residuals_[c * count + i] * residuals_[c * count + i];
    view.setWeight(i, 1.0F / (1.0F + outlier * squares));
  }
}

// A frame in another paint correlates with the reference's; its contrast with the wall is another.
double RingScore::weighContrasts() {
  gains_.clear();
  for (const Share& share : shares_)
    if (share.alike > 0.0 && share.gain > 0.0) gains_.push_back(static_cast<float>(share.gain));
  if (gains_.empty()) return 1.0;
  const auto middle = gains_.begin() + static_cast<std::ptrdiff_t>(gains_.size() / 2);
  std::nth_element(gains_.begin(), middle, gains_.end());
  const double contrast = std::clamp<double>(*middle, kMinRingGain, kMaxRingGain);
  for (Share& share : shares_) {
    if (share.alike <= 0.0 || share.gain <= 0.0) continue;
    const double off = std::log(share.gain / contrast);
    share.faithful = share.alike * std::exp(-0.5 * off * off / share.variance);
  }
  return *middle;
}

}  // namespace window_ingress::detection
