#include "detection/tracking/appearance_gate.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr int kEnough = 3;       // comparisons
constexpr double kWeight = 0.3;  // of the last one

}  // namespace

void AppearanceGate::note(double distance, double stamp_sec) {
  if (!std::isfinite(distance) || !std::isfinite(stamp_sec)) return;
  if (!allows(distance, stamp_sec)) return;
  const bool is_gap = std::abs(stamp_sec - last_sec_) > kValidSec;
  if (is_gap) forget();
  smoothed_ += (notes_ == 0 ? 1.0 : kWeight) * (distance - smoothed_);
  last_sec_ = stamp_sec;
  if (++notes_ >= kEnough) best_ = std::min(best_, smoothed_);
}

bool AppearanceGate::allows(double distance, double stamp_sec) const {
  const bool is_known = best_ < kUnknown && std::abs(stamp_sec - last_sec_) <= kValidSec;
  return !is_known || distance <= best_ + kMargin;
}

}  // namespace window_ingress::detection
