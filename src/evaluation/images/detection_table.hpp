#pragma once

#include <optional>
#include <string>

#include "window_ingress/detection/detection_trace.hpp"
#include "window_ingress/detection/window_observation.hpp"
#include "window_ingress/estimation/window_pose_estimator.hpp"

namespace window_ingress::evaluation {

/// What the detector, and the pose if there is one, said of one image.
struct DetectionRow {
  std::optional<detection::WindowObservation> window;
  std::string reject_reason;  ///< without a window: the outcome in one word, or with pose trouble that
  std::optional<estimation::WindowPoseEstimate> pose;
  double milliseconds = 0.0;
};

/// Names of the columns after the first, comma between them:
/// detected,score,bhattacharyya,x1,y1,...,y4,reject_reason,qx,qy,qz,qw,tx,ty,tz,yaw_sigma_rad,ambiguity,milliseconds.
/// `ambiguity` is the odds of the other planar solution against the reported one, 0 (none) to 1 (a toss-up).
std::string detectionColumns();

/// The values of those columns; empty where there is nothing to say, corners that are not seen included. No
/// line end.
std::string detectionValues(const DetectionRow& row);

/// Columns of a table of all candidates, after the image's name:
/// rank,proposed,source,reason,value,limit,score,bhattacharyya,x1,y1,...,x4,y4.
/// `rank` is the place by the last word about it, the target first; `proposed` the place that the search gave
/// it before anything was compared, empty for one stopped at the gates or located afterwards. Both count
/// from 1.
std::string candidateColumns();

/// A line a candidate, by rank, each starting with `first` and a comma, and ended.
std::string candidateRows(const std::string& first, const detection::DetectionTrace& trace);

}  // namespace window_ingress::evaluation
