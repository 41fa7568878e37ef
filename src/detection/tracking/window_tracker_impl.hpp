/// Implementation of the tracker. Tracking is in window_tracker.cpp, the search for untracked windows in
/// lost_track_search.cpp.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "detection/tracking/appearance_monitor.hpp"
#include "detection/tracking/image_sequence.hpp"
#include "detection/tracking/quad_tracker.hpp"
#include "detection/tracking/track_memory.hpp"
#include "detection/tracking/track_recheck.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::detection {

struct WindowTracker::Impl {
  explicit Impl(const DetectorParams& p)
      : params(p),
        detector(p),
        images(p.track.max_gap_sec),
        reference(p),
        motion(),
        memory(p.track),
        recheck(p.track) {}

  void begin(const TrackInput& input);
  void heedExpected(const TrackInput& input);
  std::optional<WindowObservation> lookForWindow(const TrackInput& input);
  std::optional<WindowObservation> updated(const TrackInput& input);
  void survey(const TrackInput& input, const std::optional<WindowObservation>& target);
  void predict();
  bool knowsTurn() const;
  QuadSpread spread() const;
  bool follow(const TrackInput& input);
  void watch(const TrackInput& input);
  void realign(const TrackInput& input);
  std::optional<WindowObservation> search(const TrackInput& input);
  std::optional<WindowObservation> amongOthers(const TrackInput& input, const WindowObservation& found);
  void take(const TrackInput& input, WindowObservation& found, bool is_same);
  /// Rejects the window of the search.
  void refuse(RejectReason reason, const std::string& detail) {
    has_own_trace = true;
    own_trace = detector.trace();
    own_trace.target = -1;
    own_trace.outcome = reason;
    own_trace.detail = detail;
  }
  std::optional<WindowObservation> complete(const TrackInput& input);
  std::optional<WindowObservation> askSearch(const TrackInput& input);
  bool surrounds(const TrackInput& input);
  void forgetTrack() {
    memory.forget();
    has_motion = tracking = false;
  }
  void forget() {
    forgetTrack();
    images.forget();
  }

  DetectorParams params;
  WindowDetector detector;
  ImageSequence images;
  AppearanceMonitor reference;
  QuadMotion motion;
  QuadTracker quad_tracker;
  TrackMemory memory;
  AppearanceGate appearance_gate;
  TrackRecheck recheck;
  WindowObservation window;  // as tracked last
  DetectionTrace own_trace;  // if the search's trace does not tell what happened
  double certainty = 0.0;
  std::vector<SeenWindow> windows;
  double searched_sec = 0.0;
  int frames_to_alignment = 0, frames_to_completion = 0, frames_elsewhere = 0;
  bool was_searched = false, place_is_expected = false;
  bool tracking = false, has_motion = false, has_own_trace = false;
};

}  // namespace window_ingress::detection
