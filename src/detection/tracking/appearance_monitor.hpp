#pragma once

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
  void note(double distance, double stamp_sec);
  /// Whether a window at this distance may be the target. Anything may where nothing is known, or once the
  /// target has been out of sight for `kValidSec`: the light may be another.
  bool allows(double distance, double stamp_sec) const;

  double best() const { return best_; }  ///< of the target so far, smoothed; 2 where nothing is known

 private:
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

  void start();                        ///< another window is followed
  void restart() { unlike_ = false; }  ///< the same one, as a search has just seen it

  /// Called with each image in which all sides are in view; looks every `TrackParams::appearance_every`.
  /// \param window as observed; takes the appearance \return false: it looks otherwise
  bool look(const TrackInput& input, WindowObservation& window);
  /// Right after a look that agreed: takes over part of what differs.
  void adapt(const TrackInput& input, const WindowObservation& window);

  bool isKnown() const { return reference_ != nullptr; }  ///< there is something to compare with
  bool hasCompared() const { return compared_; }          ///< `look` has compared the last image
  bool hasAgreed() const { return agreed_; }  ///< `look` has looked at the last image, and it was alike
  bool isUnlike() const { return unlike_; }   ///< the last time that it was looked at
  double drift() const { return reference_ ? reference_->drift() : 0.0; }

 private:
  DetectorParams params_;
  std::shared_ptr<ReferenceAppearance> reference_;  // shared with the search
  int frames_to_comparison_ = 0;
  bool unlike_ = false, agreed_ = false, compared_ = false;
};

}  // namespace window_ingress::detection
