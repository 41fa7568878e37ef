#pragma once

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

/// The paper's pipeline: image in, the target window out. Reuses its buffers from frame to frame; one object
/// a thread.
class WindowDetector {
 public:
  /// \throws std::invalid_argument that lists every parameter out of range
  explicit WindowDetector(const DetectorParams& params);
  ~WindowDetector();

  void setParams(const DetectorParams& params);  ///< \throws std::invalid_argument, and keeps the old ones
  void setReference(const ReferenceAppearance& reference);
  /// The same; what its owner adapts later is seen here.
  void shareReference(std::shared_ptr<const ReferenceAppearance> reference);
  void clearReference();

  /// Finds the target in one image, independent of the images before.
  /// \param image CV_8UC1 or CV_8UC3 (BGR), any size; not kept
  /// \param camera calibration of the image if there is one: borders are then fitted as straight lines of the
  ///        undistorted image; without it the image is taken as free of distortion
  /// \return nothing if no candidate passes all gates; `trace()` then says why
  std::optional<WindowObservation> detect(const cv::Mat& image, double stamp_sec,
                                          const geometry::PinholeCamera* camera = nullptr);

  /// Where the borders of a window near this place are, if it is the reference's: where what lies round the
  /// reference's opening fits, averaged with what shows of its borders there. Nothing without a camera, or
  /// where that does not fit.
  std::optional<RefinedBorders> bordersNear(const geometry::Quadrilateral& place, const cv::Mat& image,
                                            const geometry::PinholeCamera* camera) const;

  /// \param watch told of each stage that is done, or null; outlives this, and its `begin` is for its owner
  void setWatch(StageTimer* watch);
  StageTimer* watch() const;

  /// What happened to every candidate of the last image.
  const DetectionTrace& trace() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// A window whose borders were fitted where a search had seen it.
WindowObservation observationOf(const CandidateTrace& candidate, const RefinedBorders& borders,
                                double stamp_sec);

/// Reference from an image that is the target with its frame, without corners given: the detector looks for
/// the inner border in the image; where it finds none, the frame is taken to be a twentieth of the image
/// wide.
ReferenceAppearance referenceFromImage(const cv::Mat& image, const DetectorParams& params);

}  // namespace window_ingress::detection
