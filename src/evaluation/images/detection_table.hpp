#pragma once

#include <optional>
#include <string>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"

namespace window_ingress::evaluation {

/// Detection in one image and its pose, if there is one.
struct DetectionRow {
  std::optional<detection::WindowObservation> window;
  std::string reject_reason;  ///< without a window: the outcome in one word; without a pose: its reason
  std::optional<estimation::WindowPoseEstimate> pose;
  double milliseconds = 0.0;
};

/// Names of the columns after the first, separated by commas. `ambiguity` is the odds of the other planar
/// solution against the reported one, 0 (none) to 1 (equally likely).
std::string detectionColumns();

/// The values of these columns; empty if there is no value, or for a corner not seen. No line end.
std::string detectionValues(const DetectionRow& row);

/// Columns of a table of all candidates, after the image's name. `rank` is the final rank, the
/// target first. `proposed` is the rank given by the search before any comparison; it is empty for candidates
/// rejected by the gates or located afterwards. Both count from 1.
std::string candidateColumns();

/// One line per candidate, by rank, each starting with `first` and a comma, with line ends.
std::string candidateRows(const std::string& first, const detection::DetectionTrace& trace);

}  // namespace window_ingress::evaluation
