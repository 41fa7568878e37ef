#pragma once

#include <optional>
#include <string>

#include "evaluation/images/detection_table.hpp"
#include "window_ingress/detection/window_detector.hpp"
#include "window_ingress/detection/window_tracker.hpp"

namespace window_ingress::tools {

/// Looks for the window in each image by itself, or follows it from image to image.
class WindowFinder {
 public:
  /// \param sequence_hz the images are a sequence of so many a second; 0: each stands alone
  WindowFinder(const detection::DetectorParams& params,
               const std::optional<detection::ReferenceAppearance>& reference, double sequence_hz)
      : frame_sec_(sequence_hz > 0.0 ? 1.0 / sequence_hz : 0.0) {
    if (sequence_hz > 0.0)
      tracker_.emplace(params);
    else
      detector_.emplace(params);
    if (reference && tracker_) tracker_->setReference(*reference);
    if (reference && detector_) detector_->setReference(*reference);
  }

  std::optional<detection::WindowObservation> find(const cv::Mat& image,
                                                   const geometry::PinholeCamera* camera) {
    if (detector_) return detector_->detect(image, 0.0, camera);
    detection::TrackInput input;
    input.image = image;
    input.stamp_sec = frame_sec_ * static_cast<double>(++frames_);
    input.camera = camera;
    return tracker_->update(input);
  }

  void skip() { ++frames_; }
  const detection::DetectionTrace& trace() const {
    return detector_ ? detector_->trace() : tracker_->trace();
  }

  std::string columns() const { return tracker_ ? ",target_id,visible_sides" : ""; }
  std::string values(const evaluation::DetectionRow& row) const {
    if (!tracker_) return "";
    if (!row.window) return ",,";
    return "," + std::to_string(row.window->target_id) + "," + std::to_string(row.window->visibleSides());
  }

 private:
  double frame_sec_;
  long frames_ = 0;
  std::optional<detection::WindowDetector> detector_;
  std::optional<detection::WindowTracker> tracker_;
};

}  // namespace window_ingress::tools
