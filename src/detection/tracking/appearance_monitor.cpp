#include "detection/tracking/appearance_monitor.hpp"

namespace window_ingress::detection {
namespace {

constexpr double kAdaptation = 0.1;  ///< part of a difference in appearance that a comparison takes over

}  // namespace

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
