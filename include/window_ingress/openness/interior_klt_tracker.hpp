#pragma once

#include <memory>
#include <opencv2/core.hpp>

#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/openness/interior_klt_params.hpp"

namespace window_ingress::openness {

/// Follows the texture within the opening from a key image to each later one.
///
/// The opening is straightened by the homography of its four corners, in both images to the same rectangle:
/// what lies in the plane of the border stays where it is in there, what lies behind moves. So the flow
/// between the two (pyramidal Lucas-Kanade, forth and back) is small whatever the vehicle does, and starts
/// where the image before ended. The straightening is but an aid: what is handed out are points of the
/// images as they came. A new key image is taken when the points get lost, the window has grown, or the key
/// is old; so the stretches of the flight between key images are disjoint.
///
/// Keeps its memory from image to image. One object a thread.
class InteriorKltTracker {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit InteriorKltTracker(const InteriorKltParams& params);
  ~InteriorKltTracker();

  /// \param image CV_8UC1 or CV_8UC3 (BGR), in which the window was seen; not kept
  /// \param window receives `interior`. A window that is not whole gets none; another `target_id`, or time
  ///        that goes back, begins anew.
  void follow(const cv::Mat& image, detection::WindowObservation& window);
  void reset();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace window_ingress::openness
