#pragma once

#include <optional>
#include <vector>

#include "window_ingress/detection/window_tracker.hpp"
#include "window_ingress/openness/interior_klt_tracker.hpp"

namespace window_ingress::perception {

/// Where the target was expected as of one image says nothing of another one so much later [s].
constexpr double kExpectationLastsSec = 0.5;

/// Image to window observation: the target is searched or tracked, then the texture within its opening is
/// followed. Node, replay and closed loop all see through this.
///
/// Deterministic: the same images and the same knowledge beside them give the same observations. Keeps its
/// memory from image to image. One object a thread.
class WindowPerception {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  WindowPerception(const detection::DetectorParams& detector, const openness::InteriorKltParams& interior);

  /// The target in this image, its interior included; nothing if it is not seen, `trace()` says why.
  const std::optional<detection::WindowObservation>& update(const detection::TrackInput& frame);

  /// As the last update returned it.
  const std::optional<detection::WindowObservation>& window() const { return window_; }
  /// All windows of the last image, as far as it was searched.
  const std::vector<detection::SeenWindow>& windows() const { return tracker_.windows(); }
  const detection::DetectionTrace& trace() const { return tracker_.trace(); }

  void setParams(const detection::DetectorParams& params) { tracker_.setParams(params); }
  void setReference(const detection::ReferenceAppearance& reference) { tracker_.setReference(reference); }
  void setWatch(detection::StageTimer* watch) { tracker_.setWatch(watch); }
  /// Forgets what was seen; parameters and reference stay.
  void reset();

 private:
  detection::WindowTracker tracker_;
  openness::InteriorKltTracker interior_;
  std::optional<detection::WindowObservation> window_;
};

}  // namespace window_ingress::perception
