#include "detection/tracking/appearance_monitor.hpp"

#include <algorithm>
#include <cmath>

namespace window_ingress::detection {
namespace {

constexpr int kEnough = 3;       // comparisons
constexpr double kWeight = 0.3;  // of the last one

constexpr double kAdaptation = 0.1;  ///< part of a difference in appearance that a comparison takes over

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

void AppearanceMonitor::start() {
  restart();
  frames_to_comparison_ = params_.track.appearance_every;
}

bool AppearanceMonitor::look(const TrackInput& input, WindowObservation& window) {
  agreed_ = compared_ = false;
  if (!reference_ || --frames_to_comparison_ > 0) return true;
  frames_to_comparison_ = params_.track.appearance_every;
  if (!window.whole()) return true;
  const auto match = reference_->compare(input.image, window.corners, params_.appearance);
  window.has_appearance = match.has_value();
  window.bhattacharyya = match ? match->distance : 0.0;
  compared_ = window.has_appearance;
  unlike_ = match && !match->isLike();
  agreed_ = match && !unlike_;
  return !unlike_;
}

void AppearanceMonitor::adapt(const TrackInput& input, const WindowObservation& window) {
  reference_->adapt(input.image, window.corners, kAdaptation, params_.appearance);
}

}  // namespace window_ingress::detection
