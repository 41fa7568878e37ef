#pragma once

#include <memory>
#include <utility>

#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection {

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
