#pragma once

#include <functional>
#include <memory>
#include <opencv2/core.hpp>
#include <optional>

#include "window_ingress/detection/border_refinement.hpp"
#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/detector_params.hpp"
#include "window_ingress/detection/reference_appearance.hpp"
#include "window_ingress/detection/stage_timer.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/geometry/pinhole_camera.hpp"

namespace window_ingress::detection {

/// The paper's pipeline: image in, the target window out. Reuses its buffers: one object per thread.
class WindowDetector {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowDetector(const DetectorParams& params);
  ~WindowDetector();

  void setParams(const DetectorParams& params);  ///< \throws std::invalid_argument, and keeps the old ones
  void setReference(const ReferenceAppearance& reference);
  /// The same; later adaptations by its owner take effect here.
  void shareReference(std::shared_ptr<const ReferenceAppearance> reference);
  void clearReference();

  /// Finds the target in one image, independent of the images before.
  /// \param image CV_8UC1 or CV_8UC3 (BGR), any size; not kept
  /// \param camera calibration of the image, if there is one: borders are then fitted as straight lines of
  ///        the undistorted image; without it the image counts as free of distortion
  /// \return nothing if no candidate passes all gates; `trace()` then says why
  std::optional<WindowObservation> detect(const cv::Mat& image, double stamp_sec,
                                          const geometry::PinholeCamera* camera = nullptr);

  /// The best window that the last search passed over for a better one, of those at a wanted place. It is
  /// `better` itself if both are borders of one window. \param image, camera as in that search
  std::optional<WindowObservation> passedOver(
      const WindowObservation& better, const std::function<bool(const geometry::Quadrilateral&)>& is_wanted,
      const cv::Mat& image, const geometry::PinholeCamera* camera) const;

  /// Borders of the reference's window near this place: the place where the reference's surroundings match,
  /// averaged with the borders seen there. Nothing without a camera or without a match.
  std::optional<RefinedBorders> bordersNear(const geometry::Quadrilateral& place, const cv::Mat& image,
                                            const geometry::PinholeCamera* camera) const;

  /// \param timer notified of each finished stage, or null; must outlive this object; the owner calls its
  /// `begin`
  void setTimer(StageTimer* timer);
  StageTimer* timer() const;

  /// What happened to every candidate of the last image.
  const DetectionTrace& trace() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Reference from an image of the target with its frame, without given corners. The detector looks for the
/// inner border; if it finds none, the frame is assumed to be a twentieth of the image wide.
ReferenceAppearance referenceFromImage(const cv::Mat& image, const DetectorParams& params);

}  // namespace window_ingress::detection
