#include "detection/alignment/ring_score.hpp"

#include <cmath>

#include "detection/alignment/ring_view.hpp"
#include "window_ingress/geometry/median.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kGainSpread = 0.3;  ///< standard deviation of a segment's contrast over the whole ring's [1]
constexpr double kMinRingGain = 0.8, kMaxRingGain = 1.25;  ///< of the ring: other exposure or tone curve

// The ring's contrast relative to the reference's; `parts`: the segments' correlations as far as they share
// it. A frame in another paint still correlates with the reference's; but its contrast with the wall differs.
double weighContrasts(const std::vector<RingSegment>& segments, std::vector<WeightedSum>& parts) {
  const auto is_like = [](const RingSegment& s) { return s.alike > 0.0 && s.gain > 0.0F; };
  thread_local std::vector<float> gains;
  gains.clear();
  for (const RingSegment& s : segments)
    if (is_like(s)) gains.push_back(s.gain);
  const double middle = gains.empty() ? 1.0 : geometry::median(gains);
  const double contrast = std::clamp(middle, kMinRingGain, kMaxRingGain);
  parts.clear();
  for (const RingSegment& s : segments) {
    const double off = is_like(s) ? std::log(s.gain / contrast) : 0.0;
    const double variance = kGainSpread * kGainSpread + s.noise / s.xx;  // of the gain's logarithm
    addParts(is_like(s) ? s.alike * std::exp(-0.5 * off * off / variance) : 0.0, s, parts);
  }
  return middle;
}

}  // namespace

RingMatch matchOf(RingView& view) {
  RingMatch match;
  const std::vector<RingSegment>& segments = view.segments();
  const WeightedSum correlation = correlationOf(segments);
  match.correlation = correlation.mean();
  if (!(correlation.weight > 0.0)) return match;
  thread_local std::vector<WeightedSum> parts;
  match.contrast = weighContrasts(segments, parts);
  for (const WeightedSum& part : parts) match.faithful += part.sum / correlation.weight;
  view.coverOutliers(RingView::kCoverPasses);
  weighContrasts(view.segments(), parts);
  match.faithful_uncovered = meanUncovered(parts);
  return match;
}

}  // namespace window_ingress::detection
