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

/// One image and what is known at its exposure.
struct TrackInput {
  cv::Mat image;                                    ///< CV_8UC1 or CV_8UC3 (BGR); not kept
  double stamp_sec = 0.0;                           ///< exposure
  const geometry::PinholeCamera* camera = nullptr;  ///< calibration of the image if there is one
  std::optional<Eigen::Matrix3d> R_world_camera;    ///< attitude at the exposure, if known
  /// Where the memory of all windows expects the target, if known (distorted pixels); nothing else is the
  /// target.
  std::optional<geometry::Quadrilateral> expected;
};

/// The detector over time: searches until there is a window, then follows its four borders.
///
/// Each frame the four corners, seen or not, are predicted: by the change of attitude between the two
/// exposures where both are known, by their velocity in the image (what the attitude did not explain), and
/// towards the expected place where one is given. Only narrow profiles across the four sides are read, as
/// long as the prediction's uncertainty requires. A border counts if it looks as before (change of colour,
/// polarity and neighbouring edges), so that the inner border stays the inner one. The window is tracked if
/// all borders in view count (all but one while the track is certain) and its shape changed as a window's
/// can. Otherwise the same frame is searched at once.
///
/// Near the window its sides leave the view: then the observation is partial (`WindowObservation::whole`). At
/// least two sides must be seen; `QuadMotion` says what three and two sides determine.
///
/// A new track is verified by searches in the images that follow (`TrackRecheck`). The reference is shared
/// with the search and adapts slowly to the light (`ReferenceAppearance::adapt`) while a confirmed track is
/// certain. A track that no longer looks like the reference is doubtful and is checked by searches; its look
/// alone never ends it.
///
/// If the place of the target is known from elsewhere (`TrackInput::expected`), the search accepts only that
/// place, and a track of another window is dropped. While a window is tracked, the image is still searched
/// every `TrackParams::survey_sec`, for the other windows only.
///
/// `target_id`: see `TrackMemory`. While a settled track is lost, another window in view becomes the target
/// only after the old one is forgotten (`TrackParams::reacquire_sec`); it then gets a new number.
///
/// Deterministic. Reuses its memory: tracking allocates nothing. One object per thread.
class WindowTracker {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowTracker(const DetectorParams& params);
  ~WindowTracker();

  void setParams(const DetectorParams& params);  ///< \throws std::invalid_argument, and keeps the old ones
  void setReference(const ReferenceAppearance& reference);  ///< the next frame is searched
  /// Forgets the track, not the reference. Happens automatically when time jumps back, when images are
  /// further apart than `TrackParams::max_gap_sec`, or when size or calibration of the image change.
  void reset();

  /// \return nothing if the target is not seen; `trace()` then says why
  std::optional<WindowObservation> update(const TrackInput& input);

  void setTimer(StageTimer* timer);  ///< as `WindowDetector::setTimer`; tracking is a stage, too

  /// The windows of the last frame: the target if it is whole and, if the frame was searched, all others.
  const std::vector<SeenWindow>& windows() const;
  /// Trace of the last frame: of the search, or of the tracked window.
  const DetectionTrace& trace() const;
  /// True if a window is tracked; the last frame may be the search that found it.
  bool tracking() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::detection
