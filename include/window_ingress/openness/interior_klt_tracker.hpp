#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"

namespace window_ingress::openness {

/// Tracks the texture within the opening from a keyframe to each later image.
///
/// The homography of the four corners rectifies the opening to the same rectangle in both images: points in
/// the plane of the border stay in place, points behind it move. So the flow between the two (pyramidal
/// Lucas-Kanade, forward and back) is small for any motion of the vehicle, and starts where the last image
/// ended. Rectified images are used internally only: the points given out are distorted pixels. A new
/// keyframe is taken when points get lost, the window has grown, or the keyframe is old; so the stretches of
/// the flight between keyframes are disjoint.
///
/// Reuses its memory. One object per thread.
class InteriorKltTracker {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit InteriorKltTracker(const InteriorKltParams& params);
  ~InteriorKltTracker();

  /// \param image CV_8UC1 or CV_8UC3 (BGR), in which the window was seen; not kept
  /// \param window receives `interior`, but not if it is partial. Another `target_id`, or time that goes
  ///        back, starts anew.
  void follow(const cv::Mat& image, detection::WindowObservation& window);
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::openness
