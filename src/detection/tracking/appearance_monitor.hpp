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

/// How like the reference the target has been: a window that is much less so does not take its place while it
/// is out of sight. The limit of `AppearanceMatch` must let the target pass in any light; of two that pass in
/// the same light, one that is clearly less like it is another window.
class AppearanceGate {
 public:
  static constexpr double kMargin =
      0.2;  ///< a window less like the reference than the target was by this is another one
  static constexpr double kValidSec = 10.0;  ///< a comparison says what is allowed for so long [s]

  void forget() { *this = AppearanceGate(); }
  /// Bhattacharyya distance of a confirmed track, at a comparison.
  void note(double distance, double stamp_sec) {
    if (!std::isfinite(distance) || !std::isfinite(stamp_sec)) return;
    if (!allows(distance, stamp_sec)) return;
    const bool is_gap = std::abs(stamp_sec - last_sec_) > kValidSec;
    if (is_gap) forget();
    smoothed_ += (notes_ == 0 ? 1.0 : kWeight) * (distance - smoothed_);
    last_sec_ = stamp_sec;
    if (++notes_ >= kEnough) best_ = std::min(best_, smoothed_);
  }

  /// Whether a window at this distance may be the target. Anything may where nothing is known, or once the
  /// target has been out of sight for `kValidSec`: the light may be another.
  bool allows(double distance, double stamp_sec) const {
    const bool is_known = best_ < kUnknown && std::abs(stamp_sec - last_sec_) <= kValidSec;
    return !is_known || distance <= best_ + kMargin;
  }

  double best() const { return best_; }  ///< of the target so far, smoothed; 2 where nothing is known

 private:
  static constexpr int kEnough = 3;       // comparisons
  static constexpr double kWeight = 0.3;  // of the last one

  static constexpr double kUnknown = 2.0;

  double best_ = kUnknown, smoothed_ = 0.0, last_sec_ = 0.0;
  int notes_ = 0;
};

/// From time to time: does what is followed still look like the reference? While it surely does, the
/// reference follows the light.
class AppearanceMonitor {
 public:
  explicit AppearanceMonitor(const DetectorParams& params) : params_(params) {}

  void setParams(const DetectorParams& params) { params_ = params; }
  /// \param reference null: there is nothing to compare with
  void setReference(std::shared_ptr<ReferenceAppearance> reference) { reference_ = std::move(reference); }

  /// Another window is followed.
  void start() {
    restart();
    frames_to_comparison_ = params_.track.appearance_every;
  }

  void restart() { unlike_ = false; }  ///< the same one, as a search has just seen it

  /// Called with each image in which all sides are in view; looks every `TrackParams::appearance_every`.
  /// \param window as observed; takes the appearance \return false: it looks otherwise
  bool look(const TrackInput& input, WindowObservation& window) {
    compared_ = false;
    if (!reference_ || --frames_to_comparison_ > 0) return true;
    frames_to_comparison_ = params_.track.appearance_every;
    if (!window.whole()) return true;
    const auto match = reference_->compare(input.image, window.corners, params_.appearance);
    window.has_appearance = match.has_value();
    window.bhattacharyya = match ? match->distance : 0.0;
    compared_ = window.has_appearance;
    unlike_ = match && !match->isLike();
    return !unlike_;
  }

  /// Right after a look that agreed: takes over part of what differs.
  void adapt(const TrackInput& input, const WindowObservation& window) {
    reference_->adapt(input.image, window.corners, kAdaptation, params_.appearance);
  }

  bool isKnown() const { return reference_ != nullptr; }    ///< there is something to compare with
  bool hasCompared() const { return compared_; }            ///< `look` has compared the last image
  bool hasAgreed() const { return compared_ && !unlike_; }  ///< and it was alike
  bool isUnlike() const { return unlike_; }                 ///< the last time that it was looked at

 private:
  static constexpr double kAdaptation =
      0.1;  ///< part of a difference in appearance that a comparison takes over

  DetectorParams params_;
  std::shared_ptr<ReferenceAppearance> reference_;  // shared with the search
  int frames_to_comparison_ = 0;
  bool unlike_ = false, compared_ = false;
};

}  // namespace window_ingress::detection
