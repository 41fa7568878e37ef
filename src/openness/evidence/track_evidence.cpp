#include "window_ingress/openness/track_evidence.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::openness {
namespace {

constexpr double kBeforePlane_m = 0.1;  // of what closes: nothing stands further out

double outside(double value, double low, double high) { return std::max({0.0, low - value, value - high}); }

}  // namespace

DepthParts DepthParts::at(double distance_m, const OpennessParams& params) {
  const auto part = [&](double depth_m) { return depth_m / (distance_m + depth_m); };
  return {part(-std::min(kBeforePlane_m, 0.5 * distance_m)), part(params.max_depth_closed_m),
          part(params.min_depth_behind_m), part(params.max_depth_behind_m)};
}

double DepthParts::logOdds(double part, double sigma) const {
  const double closed = outside(part, closed_from, closed_to) / sigma;
  const double open = outside(part, open_from, open_to) / sigma;
  return 0.5 * (closed * closed - open * open);
}

void TrackEvidence::see(const PointParallax& look) {
  last_ = look;
  if (looks_++ == 0 || look.part_sigma < best_.part_sigma) best_ = look;
  const bool further = samples_ == 0 || look.gain_px > kGrowth * ring_[(samples_ - 1) % kSamples].gain_px;
  if (further) ring_[samples_++ % kSamples] = {look.part, look.part_sigma, look.gain_px};
}

bool TrackEvidence::isSteady(double max_sigmas) const {
  if (looks_ == 0 || std::abs(best_.across_px) > max_sigmas * best_.across_sigma_px) return false;
  for (int i = 0; i < std::min(samples_, kSamples); ++i)
    if (std::abs(ring_[i].part - best_.part) > max_sigmas * std::hypot(ring_[i].sigma, best_.part_sigma))
      return false;
  return true;
}

}  // namespace window_ingress::openness
