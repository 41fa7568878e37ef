#pragma once

#include <optional>
#include <vector>

#include "window_ingress/detection/window_tracker.hpp"
#include "window_ingress/openness/interior_klt_tracker.hpp"

namespace window_ingress::perception {

/// An expected place of the target is valid for images up to this much later [s].
constexpr double kExpectationLastsSec = 0.5;

/// Image to window observation: the target is searched or tracked, then the texture within its opening is
/// tracked. Node, replay and closed loop all use this class.
///
/// Deterministic: the same inputs give the same observations. Reuses its memory. One object per thread.
class WindowPerception {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  WindowPerception(const detection::DetectorParams& detector, const openness::InteriorKltParams& interior)
      : tracker_(detector), interior_(interior) {}

  /// The target in this image, its interior included; nothing if it is not seen, and `trace()` then says why.
  const std::optional<detection::WindowObservation>& update(const detection::TrackInput& frame) {
    window_ = tracker_.update(frame);
    if (window_) interior_.follow(frame.image, *window_);
    return window_;
  }

  /// The result of the last update.
  const std::optional<detection::WindowObservation>& window() const { return window_; }
  /// All windows of the last image, if it was searched; otherwise the target only.
  const std::vector<detection::SeenWindow>& windows() const { return tracker_.windows(); }
  const detection::DetectionTrace& trace() const { return tracker_.trace(); }

  void setParams(const detection::DetectorParams& params) { tracker_.setParams(params); }
  void setReference(const detection::ReferenceAppearance& reference) { tracker_.setReference(reference); }
  void setTimer(detection::StageTimer* timer) { tracker_.setTimer(timer); }
  /// Forgets what was seen; parameters and reference stay.
  void reset() {
    tracker_.reset();
    interior_.reset();
    window_.reset();
  }

 private:
  detection::WindowTracker tracker_;
  openness::InteriorKltTracker interior_;
  std::optional<detection::WindowObservation> window_;
};

}  // namespace window_ingress::perception
