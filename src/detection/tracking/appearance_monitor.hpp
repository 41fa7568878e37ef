#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection {

/// Tracks how well the target matches the reference, so that a window that matches much less does not replace
/// the target while it is out of sight. The limit of `AppearanceMatch` must accept the target in any light.
/// In the same light, a window that matches clearly less is another one.
class AppearanceGate {
 public:
  static constexpr double kMargin = 0.2;     ///< a window further from the reference by this is another one
  static constexpr double kValidSec = 10.0;  ///< a comparison is valid for this many seconds [s]

  /// Bhattacharyya distance of a confirmed track, at a comparison.
  void note(double distance, double stamp_sec) {
    if (!std::isfinite(distance) || !std::isfinite(stamp_sec) || !allows(distance, stamp_sec)) return;
    if (std::abs(stamp_sec - last_sec_) > kValidSec) *this = AppearanceGate();
    smoothed_ += (notes_ == 0 ? 1.0 : kWeight) * (distance - smoothed_);
    last_sec_ = stamp_sec;
    if (++notes_ >= kEnough) best_ = std::min(best_, smoothed_);
  }

  /// True if a window at this distance may be the target. Any window may if nothing is known, or once the
  /// target has been out of sight for `kValidSec`, because the light may have changed.
  bool allows(double distance, double stamp_sec) const {
    const bool is_known = best_ < kUnknown && std::abs(stamp_sec - last_sec_) <= kValidSec;
    return !is_known || distance <= best_ + kMargin;
  }

  double best() const { return best_; }  ///< smallest smoothed distance of the target so far; 2 if unknown

 private:
  static constexpr int kEnough = 3;       // comparisons
  static constexpr double kWeight = 0.3;  // of the last one
  static constexpr double kUnknown = 2.0;

  double best_ = kUnknown, smoothed_ = 0.0, last_sec_ = 0.0;
  int notes_ = 0;
};

/// Periodically compares the tracked window with the reference. While they surely match, the reference adapts
/// to the light.
class AppearanceMonitor {
 public:
  explicit AppearanceMonitor(const DetectorParams& params) : params_(params) {}

  void setParams(const DetectorParams& params) { params_ = params; }
  /// \param reference null: no comparison
  void setReference(std::shared_ptr<ReferenceAppearance> reference) { reference_ = std::move(reference); }
  void forget() { gate_ = AppearanceGate(); }  ///< how well the target matched

  /// Another window is tracked.
  void start() {
    restart();
    frames_to_comparison_ = params_.track.appearance_every;
  }
  void restart() { unlike_ = false; }  ///< the same window, just seen by a search

  /// To be called for each image with all sides in view; compares every `TrackParams::appearance_every`.
  /// \param window as observed; receives the appearance
  /// \param is_confirmed it is the target for sure \param is_certain its borders are certain, too
  /// \return false: it does not match
  bool look(const TrackInput& input, WindowObservation& window, bool is_confirmed, bool is_certain) {
    if (!reference_ || --frames_to_comparison_ > 0) return true;
    frames_to_comparison_ = params_.track.appearance_every;
    if (!window.whole()) return true;
    const auto match = reference_->compare(input.image, window.corners, params_.appearance);
    window.has_appearance = match.has_value();
    window.bhattacharyya = match ? match->distance : 0.0;
    unlike_ = match && !match->isLike();
    if (match && is_confirmed) {
      if (is_certain && !unlike_)
        reference_->adapt(input.image, window.corners, kAdaptation, params_.appearance);
      gate_.note(window.bhattacharyya, input.stamp_sec);
    }
    return !unlike_;
  }

  /// False for a window that a search found if it matches clearly less than the target did.
  bool allows(const WindowObservation& found) const {
    return !found.has_appearance || gate_.allows(found.bhattacharyya, found.stamp_sec);
  }
  bool isKnown() const { return reference_ != nullptr; }  ///< there is a reference
  bool isUnlike() const { return unlike_; }               ///< the last comparison did not match

 private:
  static constexpr double kAdaptation = 0.1;  ///< part of a difference that one comparison takes over

  DetectorParams params_;
  std::shared_ptr<ReferenceAppearance> reference_;  // shared with the search
  AppearanceGate gate_;
  int frames_to_comparison_ = 0;
  bool unlike_ = false;
};

}  // namespace window_ingress::detection
