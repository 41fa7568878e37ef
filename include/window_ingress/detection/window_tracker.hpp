#pragma once

#include <Eigen/Core>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/seen_windows.hpp"
#include "window_ingress/detection/stage_timer.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"
#include "window_ingress/geometry/quadrilateral.hpp"

namespace window_ingress::detection {

/// One image and what else is known about its moment.
struct TrackInput {
  cv::Mat image;                                    ///< CV_8UC1 or CV_8UC3 (BGR); not kept
  double stamp_sec = 0.0;                           ///< exposure
  const geometry::PinholeCamera* camera = nullptr;  ///< calibration of the image if there is one
  std::optional<Eigen::Matrix3d> R_world_camera;    ///< attitude at the exposure, if known
  /// Where the memory of all windows says the target is, in pixels of the image as it came, if it knows:
  /// nothing else is the target.
  std::optional<geometry::Quadrilateral> expected;
};

/// The detector over time: searches until there is a window, then follows its four borders.
///
/// Each frame the four corners, seen or not, are moved to where they must be by now: by the change of
/// attitude between the two exposures where both are known, by their velocity in the image (what the attitude
/// did not explain), and towards the prediction where one is given. Only narrow profiles across the four
/// sides are read, as far as the prediction is uncertain. A border counts if it looks as before: change of
/// colour, polarity, and the neighbouring edges, so that the inner border stays the inner one. The frame is
/// followed if all borders in view (but one, while the track is certain) do and the shape changed as a
/// window's can. Everything else is searched again at once, in the same frame.
///
/// Near the window its sides leave the view: then the observation is partial (`WindowObservation::whole`). At
/// least two sides must be seen. What can be known from three and from two sides: see `QuadMotion`.
///
/// A new track is verified by searches in the images that follow (`TrackRecheck`). The reference is
/// shared with the search; it follows the light slowly (`ReferenceAppearance::adapt`) while a confirmed track
/// is certain. A track that no longer looks like the reference is doubtful, and searches are asked; that
/// alone never ends it.
///
/// Where something else knows the place of the target (`TrackInput::expected`), the search waits for it
/// there, and a track of another window is given up for it. While a window is followed, the image is
/// searched every `TrackParams::survey_sec` all the same: for the other windows in it, not for the track.
///
/// `target_id`: see `TrackMemory`. While a settled track is lost, another window in view is no target
/// until the old one is forgotten (`TrackParams::reacquire_sec`); it then gets a new number.
///
/// Deterministic. Keeps its memory from frame to frame: following allocates nothing. One object a thread.
class WindowTracker {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowTracker(const DetectorParams& params);
  ~WindowTracker();

  void setParams(const DetectorParams& params);  ///< \throws std::invalid_argument, and keeps the old ones
  void setReference(const ReferenceAppearance& reference);  ///< the next frame is searched
  /// Forgets the track, not the reference. Happens by itself when time jumps back, when images are further
  /// apart than `TrackParams::max_gap_sec`, or when size or calibration of the image change.
  void reset();

  /// \return nothing if the target is not seen; `trace()` then says why
  std::optional<WindowObservation> update(const TrackInput& input);

  void setWatch(StageTimer* watch);  ///< as `WindowDetector::setWatch`; following is a stage, too

  /// The windows of the last frame: the target if it is whole, and, where the frame was searched, all others.
  const std::vector<SeenWindow>& windows() const;
  /// What happened in the last frame: the search's trace, or that of a followed window.
  const DetectionTrace& trace() const;
  /// There is a window that is followed from here on; the last frame may have been the search that found it.
  bool tracking() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::detection
